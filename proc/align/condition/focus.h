// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proc/image/picture.h"
#include "proc/image/result.h"
#include "proc/optics/outline.h"

namespace orbwatch::align {

/// Blur of a part of the picture.
struct Blur {
  double sigma = 0;  ///< sigma of the best Gaussian, the pixel's aperture included, px
  double error = 0;  ///< standard error of sigma, px
  int edges = 0;     ///< number of edges that it comes from
};

/// The blur of the reflection and of the ball itself. An autofocus locks on scratches or on the
/// limb, while the virtual image of a far room lies half a radius behind the ball's front and as
/// far before the plane of its limb. The error of either is the reason why it is not measured.
struct Focus {
  Result<Blur> reflection;
  Result<Blur> limb;

  /// Excess blur of the reflected room over the ball's limb, as a Gaussian's sigma, px; 0 if none.
  /// Error: one of the two is not measured.
  Result<double> focused_on_ball() const;
};

/// The blur of the reflection alone: step edges in one picture, see measure_focus(), at a fraction
/// of its cost. `least`: a sigma, px, up to which a rough figure is enough; the larger, the smaller
/// the picture that is looked at. Reentrant; takes some milliseconds. Error: an outline that is not
/// valid, or outside of the picture; the reason why it is not measured.
Result<Blur> reflection_blur(const Picture& picture, const optics::Outline& outline,
                             double least = 0);

/// Measures step edges in one picture of any format, so that contrast, exposure and noise affect
/// only the error. Motion does not disturb it, unless it smears. `outline`: the ball's limb. The
/// limb's figure is the rougher one: the reflection is squeezed there and merges into the
/// background of the ball. Reentrant; takes some tens of milliseconds. Error: an outline that is
/// not valid, or outside of the picture.
Result<Focus> measure_focus(const Picture& picture, const optics::Outline& outline);

}  // namespace orbwatch::align
