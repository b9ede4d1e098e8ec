#pragma once

#include "proc/image/picture.h"
#include "proc/image/result.h"
#include "proc/optics/outline.h"

namespace orbwatch::align {

/// How blurred something is in a picture.
struct Blur {
  double sigma = 0;  ///< of the Gaussian that fits best, the pixel's own aperture included, px
  double error = 0;  ///< standard error of that, px
  int edges = 0;     ///< from which it comes
};

/// The blur of what the ball reflects and of the ball itself. An autofocus locks on scratches or on
/// the limb, while the virtual image of a far room lies half a radius behind the ball's front and
/// as far before the plane of its limb. The error of either says why it is not measured.
struct Focus {
  Result<Blur> reflection;
  Result<Blur> limb;

  /// By how much the reflected room is more blurred than the ball's limb, as a Gaussian's sigma,
  /// px; 0: it is not. Error: one of the two is not measured.
  Result<double> focused_on_ball() const;
};

/// From step edges in one picture of any format, so that neither contrast nor exposure nor noise
/// count but for its error. What moves does not disturb it, unless it is smeared by its motion.
/// `outline`: the ball's limb. The limb's figure is the rougher one: the reflection is squeezed
/// there, and goes over into what is behind the ball. Reentrant; takes some tens of milliseconds.
/// Error: an outline that is none, or outside of the picture.
Result<Focus> measure_focus(const Picture& picture, const optics::Outline& outline);

}  // namespace orbwatch::align
