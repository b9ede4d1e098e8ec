// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/cli/place/place_options.h"
#include "app/cli/progress.h"
#include "proc/align/place/placement.h"
#include "proc/optics/rig.h"

namespace orbwatch::app::cli {

/// The request to be solved: the options, with the ball, the lenses and the outlines of the rig,
/// and the tags, and outlines that it lacks, as pictures show them. Points with the same
/// coordinates are one point. Error: unknown cameras, no lens, no outline, pictures that cannot be
/// read, are of another size or show no ball for sure.
CliResult<align::PlaceRequest> place_request(const PlaceOptions& options, const optics::Rig& rig,
                                             Progress& progress);

}  // namespace orbwatch::app::cli
