// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/stated_alignment.h"

#include "app/alignment/drift_correction.h"
#include "proc/align/register/registration.h"

namespace orbwatch::app {

Result<AlignmentProposal> stated_alignment(optics::Rig rig, const optics::RigCamera& camera,
                                           const std::string& method,
                                           const AlignmentChange& change) {
  const auto seen = align::by_outline(rig, camera);
  if (!seen) return tl::unexpected(seen.error());
  CameraAlignment alignment{
      .camera = seen->name, .outline = seen->outline, .registration = known_registration(*seen)};
  change(*alignment.outline, alignment.registration);
  return apply({.cameras = {alignment}}, rig).map([&] {
    return AlignmentProposal{alignment, method, "stated, not measured"};
  });
}

}  // namespace orbwatch::app
