#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""learn_limb_network.py limb|ring STRIPS: learns the weights of a network of
proc/align/detect/limb/limb_network.cpp from the strips of learn_limb_strips, and prints limb_network.inc or
ring_network.inc. Needs python3-torch; takes some minutes.

The network's output is, for each eight rays of a strip, the column in which the limb crosses them, or
none. It is the same along the limb and along the normal, so strips may have any size."""

import dataclasses
import math
import random
import sys

import numpy
import torch
from torch import nn
from torch.nn import functional

RAYS = 8  # rays of a part of the limb
PER_PIXEL = 2  # columns per pixel


@dataclasses.dataclass
class Course:
    """Parameters for learning a network."""
    width: int  # channels
    epochs: int
    batch: int  # strips
    step: float
    crop: int  # rays used at a time


COURSES = {"limb": Course(16, 30, 16, 6e-3, 128), "ring": Course(8, 7, 32, 8e-3, 96)}


class Network(nn.Module):
    """The network of limb_network.cpp: the ring is closed, and nothing is beyond the columns."""

    def __init__(self, width):
        super().__init__()
        # inputs, outputs, rays, columns, step in rays, rays before the first
        self.shapes = ((4, width, 8, 7, 4, 2), (width, width, 4, 7, 2, 1),
                       (width, width, 3, 7, 1, 1), (width, 1, 3, 5, 1, 1))
        self.layers = nn.ModuleList(nn.Conv2d(i, o, (rays, columns), stride=(step, 1))
                                    for i, o, rays, columns, step, _ in self.shapes)

    def forward(self, strips):
        """Logarithms of the odds of each column against no limb, for each part."""
        for layer, (_, _, rays, columns, step, before) in zip(self.layers, self.shapes):
            if layer is not self.layers[0]:
                strips = functional.relu(strips)
            after = rays - step - before
            strips = torch.cat([strips[:, :, -before:], strips, strips[:, :, :after]], 2)
            strips = layer(functional.pad(strips, (columns // 2, columns // 2)))
        return strips[:, 0]


def features(along, across, floor2):
    """The features of limb_network.cpp."""
    seen = ~numpy.isnan(along)
    scale = 0.5 / math.sqrt(floor2)
    along, across = (numpy.where(seen, slopes, 0) * scale for slopes in (along, across))
    return numpy.stack([along / numpy.sqrt(1 + along**2), across / numpy.sqrt(1 + across**2),
                        numpy.sign(along) * numpy.log1p(abs(along)) / 3, seen]).astype(numpy.float32)


def strips_of(file):
    """The features of each strip, and the true limb's distance from its middle for each part."""
    values = numpy.fromfile(file, numpy.float32)
    at, strips = 0, []
    while at < len(values):
        rays, columns, floor2 = int(values[at]), int(values[at + 1]), float(values[at + 2])
        limb, slopes = at + 3, at + 3 + rays
        at = slopes + 2 * rays * columns
        along, across = values[slopes:at].reshape(2, rays, columns)
        whole = rays // RAYS * RAYS
        distances = values[limb:limb + whole].reshape(-1, RAYS).mean(1)
        strips.append((torch.from_numpy(features(along, across, floor2)[:, :whole]),
                       torch.from_numpy(distances)))
    return strips


def cropped(strip, crop):
    """A random arc of a strip, as often mirrored and in negative as not."""
    slopes, distances = strip
    first = random.randrange(len(distances))
    slopes = torch.cat([slopes, slopes], 1)[:, RAYS * first:RAYS * first + crop]
    distances = torch.cat([distances, distances])[first:first + crop // RAYS]
    if random.random() < 0.5:
        slopes = slopes * torch.tensor([-1.0, -1, -1, 1])[:, None, None]
    if random.random() < 0.5:
        slopes = slopes.flip(1) * torch.tensor([1.0, -1, 1, 1])[:, None, None]
        distances = distances.flip(0)
    return slopes, distances


def loss(network, slopes, distances):
    """The cross-entropy of the true column, or of none; a limb between columns counts as both."""
    odds = network(slopes)
    columns = odds.shape[2]
    logarithms = functional.log_softmax(functional.pad(odds, (0, 1)), 2)
    column = torch.nan_to_num(distances, nan=1e6) * PER_PIXEL + (columns - 1) / 2
    seen = (column > 0) & (column < columns - 1)
    below = column.clamp(0, columns - 2).floor()
    share = column.clamp(0, columns - 1.001) - below
    at = below.long()[..., None]
    right = logarithms.gather(2, at)[..., 0] * (1 - share) + \
        logarithms.gather(2, at + 1)[..., 0] * share
    return -torch.where(seen, right, logarithms[..., columns]).mean()


def learnt(strips, course):
    network = Network(course.width)
    optimizer = torch.optim.Adam(network.parameters())
    batch, epochs = course.batch, course.epochs
    steps, step = epochs * (len(strips) // batch), 0
    for epoch in range(epochs):
        random.shuffle(strips)
        total = 0
        for first in range(0, len(strips) - batch + 1, batch):
            slopes, distances = zip(*(cropped(strip, course.crop)
                                      for strip in strips[first:first + batch]))
            rate = course.step * min(1, (step + 1) / 100) * 0.5 * (1 + math.cos(math.pi * step / steps))
            for group in optimizer.param_groups:
                group["lr"] = rate + 1e-4
            step += 1
            error = loss(network, torch.stack(slopes), torch.stack(distances))
            optimizer.zero_grad()
            error.backward()
            optimizer.step()
            total += error.item() * batch
        print(f"epoch {epoch + 1}: {total / len(strips):.3f} nats a part", file=sys.stderr)
    return network


def print_weights(network):
    """Prints for each layer a bias for each output, then the weights by input, ray, column and output."""
    for layer in network.layers:
        values = torch.cat([layer.bias, layer.weight.permute(1, 2, 3, 0).flatten()]).tolist()
        line = ""
        for value in values:
            text = f"{value:.3g}"
            text += ("" if "." in text or "e" in text else ".") + "F,"
            if len(line) + len(text) > 99:
                print(line)
                line = ""
            line += (" " if line else "") + text
        print(line)


def main():
    if len(sys.argv) != 3 or sys.argv[1] not in COURSES:
        print(__doc__)
        return 0 if sys.argv[1:] == ["--help"] else 2
    random.seed(1)
    torch.manual_seed(1)
    print_weights(learnt(strips_of(sys.argv[2]), COURSES[sys.argv[1]]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
