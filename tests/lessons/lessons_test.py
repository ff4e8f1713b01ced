#!/usr/bin/env python3
"""Runs a lesson in an empty folder and checks what it prints and draws: lessons_test.py FOLDER_OF_PROGRAMS LessonNN"""

import re
import unittest

import numpy as np

from lesson import HALF_CODE, ROOT, SIZE, Lesson, linear, picture, rows, run, source


class Lesson01(Lesson):
    NUMBER = 1

    def setUp(self):
        depths = re.search(r"depths\{([^}]*)\}", source(1))[1]
        self.depths = np.array([float(z.strip().rstrip("f")) for z in depths.split(",")])
        self.rows = [row for row in rows(self.printed) if len(row) == 3]

    def test_the_exact_answer_is_exact(self):
        self.assertEqual(len(self.rows), 37)
        for receiver, exact, _ in self.rows:
            if np.abs(self.depths - receiver).min() > 1e-3: # where decimals do not decide
                self.assertAlmostEqual(exact, np.mean(self.depths < receiver), delta=6e-4)

    def test_the_texel_never_darkens_what_is_lit(self):
        for _, exact, stored in self.rows:
            self.assertLessEqual(stored, exact + 1e-3)

    def test_the_texel_is_tight_between_and_behind_surfaces(self):
        for receiver, exact, stored in self.rows:
            if -0.3 < receiver < 0.2 or receiver > 0.45:
                self.assertGreater(stored, exact - 0.02)


class Lesson02(Lesson):
    NUMBER = 2

    def test_the_picture_is_lit_and_shadowed_where_it_should_be(self):
        self.check_fence(self.drawn())

    def test_the_document_shows_this_very_picture(self):
        self.check_document("lesson_hard_shadow_map")


class Lesson03(Lesson):
    NUMBER = 3

    def test_packs_give_the_bits_of_scalars(self):
        counts = re.fullmatch(r"(\d+) receivers, (\d+) differ from one at a time\n", self.printed)
        receivers, different = counts.groups()
        self.assertGreater(int(receivers), 100000)
        self.assertEqual(int(different), 0)

    def test_the_picture_is_lit_and_shadowed_where_it_should_be(self):
        self.check_fence(self.drawn())


class Lesson04(Lesson):
    NUMBER = 4

    def setUp(self):
        if self.printed.startswith("skipped: "):
            print(self.printed)
            self.skipTest("no device")

    def test_the_picture_is_lit_and_shadowed_where_it_should_be(self):
        self.check_fence(self.drawn())

    def test_the_picture_is_that_of_the_second_lesson(self):
        run(2, self.folder.name)
        difference = np.abs(self.drawn() - picture(2, self.folder.name)).max(axis=2)
        self.assertLess(difference.mean(), HALF_CODE)
        self.assertLess(np.mean(difference > 0.05), 0.002) # edges of triangles


class Lesson05(Lesson):
    NUMBER = 5
    NEAR, FAR = 0.5, 40

    def test_every_buffer_gives_the_linear_depth(self):
        buffers = [row for row in rows(self.printed) if len(row) == 8]
        self.assertEqual(len(buffers), 7)
        for distance, *depths, wrong in buffers:
            exact = 2 * (distance - self.NEAR) / (self.FAR - self.NEAR) - 1
            for depth in depths:
                self.assertAlmostEqual(depth, exact, delta=0.0051)
            perspective = self.FAR * (distance - self.NEAR) / (distance * (self.FAR - self.NEAR))
            self.assertAlmostEqual(wrong, 2 * perspective - 1, delta=0.0051)

    def test_cascades_use_their_own_planes(self):
        planes = (0.5, 3, 12, 40)
        cascades = [row for row in rows(self.printed) if len(row) == 3]
        self.assertEqual(len(cascades), 6)
        for distance, cascade, depth in cascades:
            begin, end = planes[int(cascade)], planes[int(cascade) + 1]
            self.assertTrue(begin <= distance <= end)
            self.assertAlmostEqual(depth, 2 * (distance - begin) / (end - begin) - 1, delta=0.0051)


class Lesson06(Lesson):
    NUMBER = 6

    def test_the_closed_form_is_the_share_of_time_in_shadow(self):
        text = source(6)
        lists = re.search(r"seen\{\{(.*?)\}\};", text, re.DOTALL)[1].strip().split("\n")
        number = r"([-\d.]+)f?"
        texels = [np.array(re.findall(r"\{" + ", ".join([number] * 4) + r", \d+\}", line), float) for line in lists]
        path = re.search(r"path\{\{" + ", ".join([number] * 4) + r", \d+\}, " + ", ".join([number] * 4), text).groups()
        t0, t1, z0, z1, x0, _, _, x1 = (float(word) for word in path)
        self.assertEqual((len(texels), t0, t1), (3, 0, 1))
        t = (np.arange(200000) + 0.5) / 200000
        hidden = np.zeros_like(t)
        for x, ranges in enumerate(texels):
            here = np.floor(x0 + (x1 - x0) * t) == x
            for begin, end, near, far in ranges:
                depth = near + (far - near) * (t - begin) / (end - begin)
                hidden[here & (begin <= t) & (t <= end) & (depth < z0 + (z1 - z0) * t)] = 1
        closed = float(re.search(r"closed form: in shadow for ([\d.]+)", self.printed)[1])
        self.assertTrue(0.1 < closed < 0.9)
        self.assertAlmostEqual(closed, hidden.mean(), delta=2e-5)

    def test_samples_come_nearer_the_more_there_are(self):
        closed = float(re.search(r"closed form: in shadow for ([\d.]+)", self.printed)[1])
        errors = [abs(row[1] - closed) for row in rows(self.printed)]
        self.assertEqual(len(errors), 3)
        self.assertTrue(errors[0] > errors[1] > errors[2])
        self.assertLess(errors[2], 1e-4)

    def test_spans_do_not_overlap(self):
        for line in re.findall(r"texel \d.*", self.printed):
            spans = [(float(a), float(b)) for a, b in re.findall(r"([\d.]+)\.\.([\d.]+)", line)]
            self.assertTrue(spans)
            for (_, end), (begin, _) in zip(spans, spans[1:]):
                self.assertLessEqual(end, begin)


class Lesson07(Lesson):
    NUMBER = 7

    def test_the_map_has_ranges(self):
        self.assertGreater(int(re.match(r"\d+", self.printed)[0]), 512 * 512)

    def test_shadows_fall_on_the_ground_and_are_smooth(self):
        seen = self.drawn()
        self.assertEqual(seen.shape, SIZE)
        ground = linear(seen[300:]).mean(axis=2)
        self.assertLess(ground.min(), 0.6 * np.median(ground)) # dark below cubes
        self.assertGreater(np.mean(ground > 0.8 * np.median(ground)), 0.8) # lit elsewhere
        bend = np.abs(ground[:, 2:] - 2 * ground[:, 1:-1] + ground[:, :-2])
        self.assertLess(np.mean(bend > 0.03), 0.02) # no noise: bends are at edges alone

    def test_the_document_shows_this_very_picture(self):
        self.check_document("lesson_map_of_ranges")


class Lesson08(Lesson):
    NUMBER = 8

    def setUp(self):
        lines = re.findall(r"^(.*?)\s+(\d\.\d+)\s+(\d\.\d+)$", self.printed, re.MULTILINE)
        self.dark = {name: float(dark) for name, dark, _ in lines}
        self.light = {name: float(light) for name, _, light in lines}
        self.assertEqual(len(self.dark), 5)

    def test_a_depth_test_without_bias_has_acne_and_moments_have_next_to_none(self):
        self.assertGreater(self.dark["depths, no bias"], 0.3)
        self.assertLess(self.dark["moments, no bias"], 0.1)

    def test_bias_takes_darkness_and_shadows_alike(self):
        settings = ("moments, no bias", "moments, bias", "moments, 5 x bias")
        dark, light = ([column[name] for name in settings] for column in (self.dark, self.light))
        self.assertTrue(dark[0] > dark[1] > dark[2])
        self.assertTrue(light[0] < light[1] < light[2])

    def test_over_darkening_takes_light_from_shadows_and_beside_them(self):
        self.assertLess(self.light["moments, over-darkened"], 0.8 * self.light["moments, bias"])
        self.assertGreater(self.dark["moments, over-darkened"], self.dark["moments, bias"])

    def test_the_picture_shows_all_settings_side_by_side(self):
        self.assertEqual(self.drawn().shape, (400, 5 * 400 + 4 * 4, 3))

    def test_the_document_shows_this_very_picture(self):
        self.check_document("lesson_bias")


class Lesson09(Lesson):
    NUMBER = 9
    STAGE = (ROOT / "examples/renderer/scene/translucent_stage.cpp").read_text(encoding="utf-8")

    def sunlight(self, rows, columns):
        """The share of the sun's red, green and blue light on ground, by the colours of the stage and of shading.hpp."""
        albedo = np.array(re.search(r"ground\(\{[^}]*\}, 40, 40, \{(.*?)f\}", self.STAGE)[1].split("f, "), float)
        x, y, z = (float(word) for word in re.search(r"yard_light = \S+\(glm::vec3\((.*?)f\)", self.STAGE)[1].split("f, "))
        sky, sun = np.array([[0.30, 0.35, 0.44], [1.0, 0.94, 0.84]])
        seen = linear(self.drawn()[rows, columns])
        return (seen / albedo - sky) / (-y / np.sqrt(x * x + y * y + z * z) * sun)

    def test_the_ground_behind_glass_has_the_light_that_each_pane_lets_through(self):
        found = self.sunlight(slice(405, 450), slice(570, 690)).reshape(-1, 3)
        panes = re.findall(r"glass\[\d\]\.opacity = \{(.*?)f\}", self.STAGE)
        self.assertEqual(len(panes), 4)
        for pane in panes:
            transmittance = 1 - np.array(pane.split("f, "), float)
            near = np.abs(found - transmittance).max(axis=1) < 0.06
            self.assertGreater(near.sum(), 50, pane)

    def test_open_ground_is_lit_and_smoke_takes_a_part_of_the_light(self):
        self.assertLess(np.abs(self.sunlight(slice(500, 535), slice(300, 600)) - 1).max(), 0.02)
        smoke = self.sunlight(slice(405, 445), slice(210, 430))
        self.assertGreater(np.mean((smoke > 0.1) & (smoke < 0.9)), 0.3)
        self.assertGreater(smoke.min(), -0.02)

    def test_the_document_shows_this_very_picture(self):
        self.check_document("lesson_translucent_map")


class Lesson10(Lesson):
    NUMBER = 10

    def width(self, y):
        """Pixels from 90% to 10% of the shadow of the left post, on its right side, in a row without other shadows."""
        row = linear(self.drawn()[y, 190:420]).mean(axis=1)
        share = (row.max() - row) / (row.max() - row.min())
        outwards = share[int(np.argmax(share[: int(2.3 * (y - 430)) + 25])) :]
        return int(np.argmax(outwards < 0.1)) - int(np.argmax(outwards < 0.9))

    def test_the_shadow_of_a_post_gets_softer_in_proportion_to_the_distance_from_its_foot(self):
        rows = np.array([438, 446, 458, 470])
        widths = [self.width(y) for y in rows]
        slope, begin = np.polyfit(rows, widths, 1)
        self.assertGreater(slope, 0.25)
        self.assertLess(np.abs(np.polyval((slope, begin), rows) - widths).max(), 1.5)
        self.assertLess(np.polyval((slope, begin), 430), 3) # the foot of the post

    def test_the_ground_is_lit_and_shadowed_where_it_should_be(self):
        seen = linear(self.drawn())
        lit, umbra = seen[250:300, 250:400], seen[459:463, 455:500]
        self.assertLess(np.ptp(lit, axis=(0, 1)).max(), 0.002) # no acne
        self.assertLess(np.ptp(umbra, axis=(0, 1)).max(), 0.02) # no leaks
        self.assertLess(umbra.mean(), 0.4 * lit.mean())

    def test_the_document_shows_this_very_picture(self):
        self.check_document("lesson_soft_shadow")


class Lesson11(Lesson):
    NUMBER = 11

    def test_shafts_of_light_stand_before_the_wall_below_the_windows(self):
        row = linear(self.drawn()[320:340, 640:900]).mean(axis=(0, 2))
        shafts = (row - np.convolve(row, np.ones(81) / 81, "same"))[45:-45]
        self.assertGreater(shafts.std(), 0.005)
        self.assertGreaterEqual(np.count_nonzero(np.diff(np.sign(shafts))), 3)

    def test_air_is_dark_where_no_light_reaches_the_view_ray(self):
        chamber = linear(self.drawn()[250:312, 488:540]).mean(axis=2) # seen through the opening, behind a shaft
        dark, shaft = chamber[:4, :8].mean(), chamber[-8:, 8:].mean()
        self.assertLess(dark, 0.025)
        self.assertGreater(shaft, 4 * dark)

    def test_the_document_shows_this_very_picture(self):
        self.check_document("lesson_single_scattering")


class Lesson12(Lesson):
    NUMBER = 12
    # The shadow of two tentacles that cross, and of the tip of another one. The camera's four times alone, with the exact
    # visibility at each, make noise of 0.079 and 0.053 there.
    PENUMBRAE = (((slice(450, 520), slice(500, 620)), 0.05), ((slice(370, 430), slice(120, 180)), 0.036))

    def test_hardly_a_tile_has_four_layers(self):
        layers, tiles = (int(number) for number in re.match(r"(\d+) layers in (\d+) tiles", self.printed).groups())
        self.assertTrue(0.5 * tiles < layers < 2 * tiles)

    def test_ground_is_lit_and_shadowed_where_it_should_be(self):
        seen = linear(self.drawn()).mean(axis=2)
        self.assertEqual(self.drawn().shape, SIZE)
        lit, umbra = seen[440:530, 720:900], seen[305:330, 400:480]
        self.assertGreater(lit.min(), 0.6)
        self.assertLess(np.ptp(umbra), 0.01)
        self.assertLess(umbra.mean(), 0.3 * lit.mean())

    def test_penumbrae_have_less_noise_than_the_times_of_the_camera(self):
        seen = linear(self.drawn()).mean(axis=2)
        for place, most in self.PENUMBRAE:
            part = seen[place]
            around = part[:-2, 1:-1] + part[2:, 1:-1] + part[1:-1, :-2] + part[1:-1, 2:]
            self.assertLess((part[1:-1, 1:-1] - around / 4).std(), most)
            self.assertTrue(0.38 < part.mean() < 0.5) # as bright as of many times: 0.427 and 0.470

    def test_the_document_shows_this_very_picture(self):
        self.check_document("lesson_motion_blur_by_layers")


if __name__ == "__main__":
    unittest.main()
