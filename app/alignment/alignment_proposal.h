// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/model/alignment/accepted_alignments.h"
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

/// The entry that accepting the proposal adds.
inline CalibrationEntry entry_of(const AlignmentProposal& proposal) {
  CalibrationEntry entry;
  entry.method = proposal.method;
  entry.quality = proposal.quality;
  entry.alignment.cameras.push_back(proposal.alignment);
  return entry;
}

}  // namespace orbwatch::app
