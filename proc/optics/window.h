// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proc/image/result.h"
#include "proc/optics/vec.h"

namespace orbwatch::optics {

/// A flat protective glass between camera and ball, with air on both sides. A ray keeps its
/// direction and is displaced sideways; the glass's place along the ray has no effect.
struct Window {
  Vec3 normal{0, 1, 0};  ///< machine frame, any length, either side
  double thickness = 0;  ///< mm
  double index = 1.52;   ///< refractive index
};

/// Error: a normal of length 0, a thickness below 0, an index outside [1, 5].
Result<> check_window(const Window& window);

/// The lateral displacement of a ray of that unit direction by the glass, mm, perpendicular to the
/// normal: thickness (t / (n t) - r / (n r)) with t the direction within the glass (Snell). Zero
/// for a ray along the glass, which never enters it. Reentrant.
Vec3 displacement(const Window& window, const Vec3& direction);

}  // namespace orbwatch::optics
