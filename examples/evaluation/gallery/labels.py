"""Places labels in a chart so that they hide neither each other nor a mark."""

from dataclasses import dataclass

import numpy

PAD = 2.0  # pixels that stay free around a label
REACHES = (2, 6, 11, 17, 25, 35, 47, 62, 80, 102, 130, 165)  # from a mark to its label, in pixels
ANGLES = numpy.arange(24) * (numpy.pi / 12)
SWEEPS, TRIES = 8, 10

# What a place costs: a pixel of reach costs 1.
HIDES, CROSSES, COVERS_LINE = 50, 60, 2


@dataclass
class Label:
    text: str
    place: tuple  # of the mark, in pixels
    radius: float  # of the mark, in pixels
    colour: str
    size: float = 8


def area(boxes, others):
    """The area that each of n boxes (n, 4) has in common with each of m others (m, 4), as (n, m)."""
    low = numpy.maximum(boxes[:, None, :2], others[None, :, :2])
    high = numpy.minimum(boxes[:, None, 2:], others[None, :, 2:])
    return numpy.prod(numpy.clip(high - low, 0, None), axis=2)


def inside(points, boxes):
    """Whether each of n points (n, 2) lies in each of m boxes (m, 4), as (n, m)."""
    return ((points[:, None] >= boxes[None, :, :2]) & (points[:, None] <= boxes[None, :, 2:])).all(axis=2)


def crossing(starts, ends, start, end):
    """Whether the segments from starts to ends (n, 2) cross the segments from start to end (m, 2), as (n, m)."""
    def side(a, b, c):
        (ux, uy), (vx, vy) = numpy.moveaxis(b - a, -1, 0), numpy.moveaxis(c - a, -1, 0)
        return numpy.sign(ux * vy - uy * vx)

    p, q, r, s = starts[:, None], ends[:, None], start[None], end[None]
    return (side(p, q, r) * side(p, q, s) < 0) & (side(r, s, p) * side(r, s, q) < 0)


def along(leaders):
    """Points on each leader (n, 2, 2), from near its mark to near its label, as (points, n, 2)."""
    return leaders[:, 0] + numpy.linspace(0.25, 0.95, 8)[:, None, None] * (leaders[:, 1] - leaders[:, 0])[None]


def met(leaders, boxes):
    """How many points of each leader lie in boxes, and how many points of leaders lie in each box."""
    hits = sum(inside(points, boxes) for points in along(leaders))
    return hits.sum(axis=1), hits.sum(axis=0)


class Places:
    """The places that a label may have, with their leaders, and what each costs before other labels are there."""

    def __init__(self, label, width, height, frame, marks, trail):
        directions = numpy.stack((numpy.cos(ANGLES), numpy.sin(ANGLES)), axis=1)
        support = numpy.clip(1.5 * directions, -1, 1) * (width / 2, height / 2)
        reach = label.radius + numpy.array(REACHES)
        centres = label.place + (reach[:, None, None] * directions + support).reshape(-1, 2)
        half = numpy.array((width / 2 + PAD, height / 2 + PAD))
        boxes = numpy.hstack((centres - half, centres + half))
        reaches = numpy.repeat(REACHES, len(ANGLES))
        tips = numpy.clip(label.place, boxes[:, :2], boxes[:, 2:])
        leaders = numpy.stack((numpy.broadcast_to(label.place, tips.shape), tips), axis=1)
        outside = numpy.prod(boxes[:, 2:] - boxes[:, :2], axis=1) - area(boxes, numpy.array([frame]))[:, 0]
        hidden = outside + area(boxes, marks).sum(axis=1)
        # Where some places are free of marks and inside the frame, no other is worth a look.
        kept = hidden <= hidden.min() + 1e-6
        self.boxes, self.leaders, self.led = boxes[kept], leaders[kept], reaches[kept] > REACHES[1]
        self.hidden = hidden[kept]
        covered = inside(trail, self.boxes).sum(axis=0) if len(trail) else 0
        through = met(self.leaders, marks)[0] if len(marks) else 0
        self.costs = HIDES * self.hidden + reaches[kept] + COVERS_LINE * covered + CROSSES * self.led * through

    def among(self, boxes, leaders):
        """What each place costs in addition when other labels have these boxes and leaders."""
        common = area(self.boxes, boxes).sum(axis=1)
        through = met(self.leaders, boxes)[0] + 4 * crossing(self.leaders[:, 0], self.leaders[:, 1], leaders[:, 0],
                                                             leaders[:, 1]).sum(axis=1)
        under = met(leaders, self.boxes)[1]
        return HIDES * common + CROSSES * (self.led * through + under)


def settle(options, order):
    """Gives each label in turn the cheapest of its places, the others where they are, until all stay; returns the cost
    of all, boxes and leaders."""
    count = len(options)
    boxes, leaders, costs = numpy.full((count, 4), -1e6), numpy.full((count, 2, 2), -1e6), numpy.zeros(count)
    for _ in range(SWEEPS):
        before = boxes.copy()
        for i in order:
            rest = numpy.arange(count) != i
            found = options[i].costs + options[i].among(boxes[rest], leaders[rest])
            best = numpy.argmin(found)
            boxes[i], leaders[i], costs[i] = options[i].boxes[best], options[i].leaders[best], found[best]
        if (boxes == before).all():
            break
    return costs.sum(), boxes, leaders


def arrange(labels, sizes, frame, marks, trail):
    """Chooses a box for each label, the best of some tries from different orders; returns the boxes and whether each is
    free. frame: the box that holds all. marks: boxes that no label hides. trail: points on lines, better left free."""
    marks, trail = numpy.reshape(marks, (-1, 4)), numpy.reshape(trail, (-1, 2))
    options = [Places(label, *size, frame, marks, trail) for label, size in zip(labels, sizes)]
    places = numpy.array([label.place for label in labels])
    crowd = (numpy.linalg.norm(places[:, None] - places[None], axis=2) < 60).sum(axis=1)
    draw = numpy.random.default_rng(1)
    orders = [numpy.argsort(-crowd, kind="stable"), *(draw.permutation(len(labels)) for _ in range(TRIES - 1))]
    _, boxes, _ = min((settle(options, order) for order in orders), key=lambda found: found[0])
    common = area(boxes, boxes)
    apart = (common - numpy.diag(numpy.diag(common))).sum() < 1e-6
    return boxes, apart and all(option.hidden.min() < 1e-6 for option in options)


def write(axes, labels, marks, trail):
    """Writes labels beside their marks, with a leader where one is not near; returns whether all are free."""
    if not labels:
        return True
    figure = axes.figure
    renderer, scale = figure.canvas.get_renderer(), figure.dpi / 72
    to_data = axes.transData.inverted()
    texts = [axes.annotate(label.text, to_data.transform(label.place), (0, 0), textcoords="offset points", ha="center",
                           va="center", fontsize=label.size, color=label.colour, parse_math=False, zorder=5)
             for label in labels]
    extents = [text.get_window_extent(renderer) for text in texts]
    boxes, free = arrange(labels, [(extent.width, extent.height) for extent in extents],
                          axes.get_window_extent(renderer).extents, marks, trail)
    for text, label, box in zip(texts, labels, boxes):
        text.set_position(tuple(((box[:2] + box[2:]) / 2 - label.place) / scale))
        offset = numpy.clip(label.place, box[:2] + PAD, box[2:] - PAD) - label.place
        if numpy.linalg.norm(offset) > label.radius + REACHES[2]:
            axes.annotate("", text.xy, tuple(offset / scale), textcoords="offset points", zorder=4, arrowprops={
                "arrowstyle": "-", "lw": 0.6, "color": label.colour, "alpha": 0.8, "shrinkA": 0,
                "shrinkB": label.radius / scale})
    return free
