// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/model/alignment/rig_alignment.h"
#include "proc/signals/signals.h"

namespace orbwatch::app {

/// An alignment of one camera that was found or stated, and how.
struct AlignmentProposal {
  CameraAlignment alignment;
  std::string method;
  std::string quality;                          ///< known errors, for people
  double direction_sigma = signals::kNotValid;  ///< degrees
};

}  // namespace orbwatch::app
