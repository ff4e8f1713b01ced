"""Colours that can be told from the page's background, in the light scheme and in the dark one."""

import colorsys
import re

# The page's own colours, light and dark; style.css has the same.
SURFACE, INK, QUIET, GRID, FRONT = "#fcfcfd", "#20262c", "#5a6570", "#e3e7eb", "#8b959f"
DARK_SURFACE = "#14181c"
SCHEME = {SURFACE: DARK_SURFACE, INK: "#e6eaee", QUIET: "#a3aeb8", GRID: "#2b3238", FRONT: "#78838d"}

# For what has no colour of its own; after Okabe & Ito, told apart by those who see few colours.
SERIES = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c6d31", "#6a51a3")

GREY = 0.15  # a colour of less saturation
GRAPHIC, TEXT = 3.0, 4.5  # the contrast that WCAG 2 wants of a mark, and of small letters


def channels(colour):
    return [int(colour[i:i + 2], 16) / 255 for i in (1, 3, 5)]


def luminance(colour):
    """The relative luminance of sRGB (WCAG 2)."""
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in channels(colour)]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(a, b):
    lighter, darker = sorted((luminance(a), luminance(b)), reverse=True)
    return (lighter + 0.05) / (darker + 0.05)


def of_hls(hue, lightness, saturation):
    return "#" + "".join(f"{round(255 * c):02x}" for c in colorsys.hls_to_rgb(hue, lightness, saturation))


def readable(colour, ratio=GRAPHIC, surface=SURFACE):
    """The colour, darker or lighter by as much as its contrast with the surface needs."""
    hue, lightness, saturation = colorsys.rgb_to_hls(*channels(colour))
    step = 0.01 if luminance(surface) < 0.2 else -0.01
    while contrast(colour, surface) < ratio and 0 < lightness + step < 1:
        lightness += step
        colour = of_hls(hue, lightness, saturation)
    return colour


def dark(colour):
    """The colour of the dark scheme that stands for one of the light scheme. Black and white change places."""
    if colour in SCHEME:
        return SCHEME[colour]
    hue, lightness, saturation = colorsys.rgb_to_hls(*channels(colour))
    turned = of_hls(hue, 1 - lightness, saturation) if saturation < GREY else colour
    return readable(turned, TEXT, DARK_SURFACE)


def darkened(svg, used):
    """The text of an SVG file with the used colours replaced by those of the dark scheme."""
    swaps = {colour: dark(colour) for colour in used}
    return re.sub("#[0-9a-f]{6}", lambda match: swaps.get(match[0], match[0]), svg)
