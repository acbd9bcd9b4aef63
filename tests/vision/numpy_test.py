#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What armature/vision finds in pictures with a ball, a post, a box, a screen and noise is what numpy and
plain Python find by the definitions: hue, saturation and value, connected components, the largest round one.

usage: numpy_test.py FIND_BALLS
"""

import math
import subprocess
import sys
import unittest

import numpy

FIND_BALLS = sys.argv[1]
WIDTH, HEIGHT = 160, 120
WANTED, HUE_TOLERANCE, MIN_SATURATION, MIN_VALUE, MIN_AREA = (255, 20, 10), 0.2, 0.4137, 0.1513, 20
MIN_FILL, MAX_FILL = 0.6, 0.95
RED, ORANGE, BLUE, SCREEN = (215, 35, 30), (230, 130, 20), (30, 60, 200), (70, 75, 70)
PICTURES = 400
rows, columns = numpy.mgrid[0:HEIGHT, 0:WIDTH] + 0.5


# --- pictures ------------------------------------------------------------------------------------

def floor(random):
    """Checkered, brighter below."""
    size = random.integers(6, 30)
    checks = (rows // size + columns // size) % 2
    grey = 70 + 60 * checks + 40 * rows / HEIGHT
    return numpy.repeat(grey[:, :, None], 3, axis=2)


def paint(picture, share, colour):
    picture += share[:, :, None] * (numpy.asarray(colour, float) - picture)


def box(picture, random, colour, wide, high):
    left, top = random.uniform(-10, WIDTH), random.uniform(-10, HEIGHT)
    inside = (columns > left) & (columns < left + wide) & (rows > top) & (rows < top + high)
    paint(picture, inside.astype(float), colour)


def ball(picture, x, y, radius):
    """A sphere with light from above, its edge mixed with what is behind it."""
    away = numpy.hypot(columns - x, rows - y)
    height = numpy.sqrt(numpy.clip(1 - (away / radius) ** 2, 0, 1))
    light = numpy.clip(0.55 + 0.35 * height - 0.25 * (rows - y) / radius, 0.3, 1.1)[:, :, None]
    share = numpy.clip(radius - away + 0.5, 0, 1)[:, :, None]
    picture += share * (light * numpy.asarray(RED, float) - picture)


def picture_of(number):
    """A picture and its ball if it is whole in sight: x, y, radius."""
    random = numpy.random.default_rng(number)
    picture = floor(random)
    box(picture, random, ORANGE, random.uniform(5, 15), random.uniform(40, 90))
    box(picture, random, BLUE, random.uniform(15, 40), random.uniform(15, 40))
    if number % 5 == 1:
        box(picture, random, RED, random.uniform(8, 20), random.uniform(8, 20))  # of its colour, not round
    truth = None
    if number % 4 != 0:
        radius = random.uniform(3.2, 16)
        x, y = random.uniform(-radius / 2, WIDTH + radius / 2), random.uniform(-radius / 2, HEIGHT + radius / 2)
        ball(picture, x, y, radius)
        if number % 3 == 0:
            box(picture, random, SCREEN, random.uniform(20, 60), random.uniform(20, 100))
        elif radius < x < WIDTH - radius and radius < y < HEIGHT - radius and number % 5 != 1:
            truth = x, y, radius
    picture += random.normal(0, random.uniform(0, 10), picture.shape)
    return numpy.clip(numpy.rint(picture), 0, 255).astype(numpy.uint8), truth


# --- the definitions -----------------------------------------------------------------------------

def hue_of(picture):
    """By the angle in the plane of colours, in sixths of the circle."""
    red, green, blue = (picture[..., part].astype(float) for part in range(3))
    greatest = picture.max(axis=-1).astype(float)
    spread = greatest - picture.min(axis=-1)
    some = numpy.where(spread == 0, 1, spread)
    return numpy.select([greatest == red, greatest == green],
                        [(green - blue) / some, 2 + (blue - red) / some], 4 + (red - green) / some)


def mask_of(picture):
    greatest = picture.max(axis=-1).astype(float)
    saturation = (greatest - picture.min(axis=-1)) / numpy.maximum(greatest, 1)
    off = numpy.abs(hue_of(picture) - hue_of(numpy.asarray(WANTED, numpy.uint8)))
    off = numpy.minimum(off, 6 - off) * math.pi / 3
    return (off <= HUE_TOLERANCE) & (saturation >= MIN_SATURATION) & (greatest / 255 >= MIN_VALUE)


def blobs_of(mask):
    """The pixels of each connected component, in the order of their first ones."""
    unseen = {(int(row), int(column)) for row, column in zip(*mask.nonzero())}
    blobs = []
    for first in sorted(unseen):
        if first not in unseen:
            continue
        unseen.remove(first)
        blob, pending = [], [first]
        while pending:
            row, column = pending.pop()
            blob.append((row, column))
            for near in [(row + i, column + k) for i in (-1, 0, 1) for k in (-1, 0, 1)]:
                if near in unseen:
                    unseen.remove(near)
                    pending.append(near)
        blobs.append(numpy.array(blob))
    return blobs


def ball_of(blobs):
    """x, y, area, cut of the largest that is round enough."""
    best = None
    for blob in blobs:
        (top, left), (bottom, right) = blob.min(axis=0), blob.max(axis=0)
        fill = len(blob) / ((bottom - top + 1) * (right - left + 1))
        if len(blob) < MIN_AREA or not MIN_FILL <= fill <= MAX_FILL or (best and best[2] >= len(blob)):
            continue
        y, x = blob.mean(axis=0) + 0.5
        best = x, y, len(blob), int(top == 0 or left == 0 or bottom == HEIGHT - 1 or right == WIDTH - 1)
    return best


class Pictures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.pictures, cls.truths = zip(*map(picture_of, range(PICTURES)))
        images = b"".join(picture.tobytes() for picture in cls.pictures)
        done = subprocess.run([FIND_BALLS], input=images, capture_output=True, check=True)
        cls.answers = [line.split() for line in done.stdout.decode().splitlines()]

    def test_masks_blobs_and_balls_are_those_of_the_definitions(self):
        self.assertEqual(len(self.answers), PICTURES)
        kinds = {"none": 0, "cut": 0, "whole": 0, "several": 0}
        for number, (picture, answer) in enumerate(zip(self.pictures, self.answers)):
            with self.subTest(picture=number):
                mask = mask_of(picture)
                blobs = blobs_of(mask)
                self.assertEqual(answer[:2], [str(mask.sum()), str(len(blobs))])
                expected = ball_of(blobs)
                kinds["several"] += len(blobs) > 1
                if expected is None:
                    self.assertEqual(answer[2:], ["none"])
                    kinds["none"] += 1
                    continue
                kinds["cut" if expected[3] else "whole"] += 1
                self.assertEqual([int(each) for each in answer[4:]], list(expected[2:]))
                self.assertAlmostEqual(float(answer[2]), expected[0], delta=1e-9)
                self.assertAlmostEqual(float(answer[3]), expected[1], delta=1e-9)
        self.assertGreater(min(kinds.values()), 20, kinds)

    def test_balls_whole_in_sight_are_found_to_three_tenths_of_a_pixel(self):
        errors = []
        for number, (truth, answer) in enumerate(zip(self.truths, self.answers)):
            if truth is None:
                continue
            self.assertNotEqual(answer[2], "none", number)
            errors.append(math.hypot(float(answer[2]) - truth[0], float(answer[3]) - truth[1]))
        rms = math.sqrt(sum(error ** 2 for error in errors) / len(errors))
        print(f"{len(errors)} balls, rms {rms:.3f} px, worst {max(errors):.2f} px")
        self.assertGreater(len(errors), 80)
        self.assertLessEqual(rms, 0.3)

    def test_without_a_ball_a_post_and_a_box_are_none(self):
        for number, answer in enumerate(self.answers):
            if number % 4 == 0 and number % 5 != 1:
                self.assertEqual(answer[2], "none", number)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
