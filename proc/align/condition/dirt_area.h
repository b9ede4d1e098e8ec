#pragma once

#include "proc/align/condition/dirt_reference.h"

namespace orbwatch::align {

/// What covers the ball, px of the raster.
struct DirtArea {
  int dirty = 0;
  int largest = 0;  ///< of one spot or scratch
  int judged = 0;
};

/// The marks that `usual` has and `clean` has not. Each is counted as far as it is a third as deep
/// as at its deepest, which is half of its opacity where counts follow sRGB's curve. Left out:
/// those that are squeezed along the radius by 1 - rho^2, as what the ball reflects is (the law of
/// reflection for a far camera), and those where the room has changed. Reentrant.
DirtArea dirt_area(const SmallMarks& usual, const DirtReference& clean);

/// The share of places with detail that have kept its pattern and lost strength; 0 if there are too
/// few. Reentrant.
double dulled_share(const SmallMarks& usual, const DirtReference& clean);

}  // namespace orbwatch::align
