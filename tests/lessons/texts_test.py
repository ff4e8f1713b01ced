#!/usr/bin/env python3
"""How lessons are written: short, each the answer to one question, and listed by ./run lesson and docs/lessons.md."""

import re
import subprocess
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LESSONS = sorted((ROOT / "examples" / "lessons").glob("*.cpp"))
MAX_LINES = 80


def question_of(lesson):
    return lesson.read_text(encoding="utf-8").split("\n", 1)[0].removeprefix("// ")


def run(*words):
    return subprocess.run([ROOT / "run", *words], capture_output=True, text=True, check=False)


class Texts(unittest.TestCase):
    def test_twelve_lessons_follow_one_another(self):
        self.assertEqual([lesson.name[:3] for lesson in LESSONS], [f"{i:02}_" for i in range(1, 13)])

    def test_no_lesson_is_too_long(self):
        for lesson in LESSONS:
            self.assertLessEqual(lesson.read_text(encoding="utf-8").count("\n"), MAX_LINES, lesson.name)

    def test_the_first_comment_is_a_question(self):
        for lesson in LESSONS:
            self.assertRegex(lesson.read_text(encoding="utf-8"), r"\A// [A-Z][^\n]*\?\n//\n// ", lesson.name)

    def test_each_is_a_program_of_its_own(self):
        for lesson in LESSONS:
            self.assertEqual(lesson.read_text(encoding="utf-8").count("int main()"), 1, lesson.name)

    def test_lessons_use_the_library_and_the_renderer_and_measure_nothing(self):
        allowed = re.compile(r'<(gnomon|glm)/[^>]*>|"renderer/[^"]*"|"04_on_vulkan/shaders.hpp"|<[a-z]+>')
        for lesson in LESSONS:
            for included in re.findall(r"^#include (\S+)", lesson.read_text(encoding="utf-8"), re.MULTILINE):
                self.assertRegex(included, rf"\A(?:{allowed.pattern})\Z", lesson.name)
                self.assertNotIn(included, ("<chrono>", "<ctime>"), lesson.name)

    def test_the_document_leads_through_all_of_them_in_order(self):
        text = (ROOT / "docs" / "lessons.md").read_text(encoding="utf-8")
        linked = re.findall(r"\(\.\./examples/lessons/(\w+\.cpp)\)", text)
        self.assertEqual(linked, [lesson.name for lesson in LESSONS])
        for lesson in LESSONS:
            self.assertIn(question_of(lesson), text)


class Run(unittest.TestCase):
    def test_no_name_lists_names_and_questions(self):
        listed = run("lesson")
        self.assertEqual(listed.returncode, 0, listed.stderr)
        lines = [line.split(None, 1) for line in listed.stdout.splitlines()]
        self.assertEqual(lines, [[lesson.stem, question_of(lesson)] for lesson in LESSONS])

    def test_an_unknown_name_is_answered_in_one_line(self):
        for words in (("lesson", "13_nothing"), ("lesson", "_"), ("lesson", "01", "02")):
            answer = run(*words)
            self.assertEqual(answer.returncode, 2, words)
            self.assertEqual((answer.stdout, answer.stderr.count("\n")), ("", 1), words)


if __name__ == "__main__":
    unittest.main()
