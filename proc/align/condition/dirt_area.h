// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proc/align/condition/dirt_reference.h"

namespace orbwatch::align {

/// The area that dirt covers on the ball, px of the raster.
struct DirtArea {
  int dirty = 0;
  int largest = 0;  ///< area of the largest spot or scratch
  int judged = 0;
};

/// Marks that `usual` has and `clean` does not have. Each counts as far as it is at least a third
/// as deep as its deepest point, which is half of its opacity where counts follow sRGB's curve. Two
/// kinds are left out: marks that are squeezed along the radius by 1 - rho^2, as reflections are
/// (the law of reflection for a far camera), and marks where the room has changed. Reentrant.
DirtArea dirt_area(const SmallMarks& usual, const DirtReference& clean);

/// The share of places with detail that have kept its pattern and lost strength; 0 if such places
/// are too few. Reentrant.
double dulled_share(const SmallMarks& usual, const DirtReference& clean);

}  // namespace orbwatch::align
