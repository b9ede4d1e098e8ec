// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/placement.h"
#include "app/cli/command.h"
#include "app/cli/place/place_options.h"
#include "app/cli/place/place_request.h"
#include "app/cli/place/place_text.h"
#include "app/files/rig/rig_edit.h"
#include "app/files/rig/rig_file.h"

namespace orbwatch::app::cli {
namespace {

constexpr const char* kPlaceUsage =
    "Usage: orbwatch place --rig RIG --camera NAME --point U,V=X,Y,Z ...\n"
    "                      [--camera NAME --point ...] [options]\n"
    "       orbwatch place --rig RIG --camera NAME --view-point U,V=X,Y,Z ... [--view KIND ...]\n"
    "\n"
    "Finds out where cameras stand and look, from points of the machine whose coordinates are "
    "known\n"
    "and that are marked where the ball shows them: corners of the enclosure, an edge of the "
    "table,\n"
    "the tool's tip, moved to known coordinates by the machine itself.\n"
    "\n";

constexpr const char* kPlaceNotes =
    "\n"
    "Coordinates are in mm in the machine frame. U to the right and V down are measured from the\n"
    "centre of the top left pixel: of the camera's whole picture for --point, of the view's for\n"
    "--view-point. A view must have been made with the same --rig; it may be rough, since it "
    "serves\n"
    "only to find the pixel of the camera's picture again. --sigma-px is of the camera's picture.\n"
    "A point must be marked within the ball's outline. A camera with neither pose nor outline in "
    "the\n"
    "rig, which other commands refuse, needs --image.\n"
    "The same coordinates in two cameras are the same point. Each camera needs two points, three "
    "when its\n"
    "focal length is unknown; one camera needs four when the ball's centre is. More points, in "
    "all\n"
    "directions and some near the ball, make it better and show mistakes.\n"
    "\n"
    "A tag is given by its id, and the corners of its black border as one reads it, top left, top\n"
    "right, bottom right, bottom left: ID=X,Y,Z,X,Y,Z,X,Y,Z,X,Y,Z; or by its size, its centre and "
    "the\n"
    "directions to its right and down: ID=SIZE,X,Y,Z,X,Y,Z,X,Y,Z. Four tags that fill 15 degrees "
    "each\n"
    "as the ball sees them, in different directions, are enough.\n"
    "\n"
    "What decides is the direction's figure: by how much the directions of the camera's views are\n"
    "wrong, one sigma. A point that contradicts the others is named and left out; -o then writes\n"
    "nothing.\n"
    "\n"
    "--json prints one object: ball_centre [x, y, z] and ball_centre_sigma (rms length) in mm,\n"
    "reduced_chi_square, redundancy (equations more than unknowns), cameras [{name, position\n"
    "[x, y, z] in mm, rotation (3x3 by rows: the camera's right, down and forward in the machine\n"
    "frame), focal_length [fx, fy] and, when it was unknown, focal_sigma in px, position_sigma\n"
    "(rms length, mm), rotation_sigma and direction_sigma (rms, degrees), covariance (6x6: a\n"
    "small rotation about the camera's axes in rad, the position in mm), points [{point [x, y, "
    "z],\n"
    "pixel [u, v], residual [u, v] marked minus shown in px (null: not shown), outlier}]}].\n";

CliResult<std::string> place(const PlaceOptions& o) {
  if (o.rig.empty()) return usage_error("--rig is missing");
  if (o.cameras.empty()) return usage_error("--camera is missing");
  const auto rig = files::load_rig(o.rig, files::Unplaced::Allowed);
  if (!rig) return tl::unexpected(rig.error());
  Progress progress;
  const auto request = place_request(o, *rig, progress);
  if (!request) return tl::unexpected(request.error());
  progress.begin("placing the cameras");
  const auto placement = align::place(*request);
  progress.erase();
  if (!placement) return tl::unexpected(placement.error());
  if (!o.output.empty()) {
    const auto written =
        rig_alignment(*request, *placement).and_then([&](const RigAlignment& alignment) {
          return files::write_aligned_rig(o.rig, alignment, o.output);
        });
    if (!written) return tl::unexpected(written.error());
  }
  return o.json ? place_json(*request, *placement) : place_text(*request, *placement);
}

}  // namespace

CliResult<std::string> place_command(const Arguments& arguments) {
  PlaceOptions o;
  return run_command(arguments,
                     {.usage = kPlaceUsage, .options = place_options(o), .notes = kPlaceNotes},
                     [&](const auto&) { return place(o); });
}

}  // namespace orbwatch::app::cli
