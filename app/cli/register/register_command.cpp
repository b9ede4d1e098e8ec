// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <optional>

#include "app/alignment/found_outline.h"
#include "app/alignment/picture_size.h"
#include "app/alignment/registration.h"
#include "app/cli/command.h"
#include "app/cli/options/camera_options.h"
#include "app/cli/options/options.h"
#include "app/cli/progress.h"
#include "app/cli/register/named_pictures.h"
#include "app/cli/register/register_text.h"
#include "app/files/rig/rig_edit.h"
#include "app/files/rig/rig_file.h"

namespace orbwatch::app::cli {
namespace {

constexpr const char* kRegisterUsage =
    "Usage: orbwatch register --rig RIG A=PATH B=PATH [options]\n"
    "\n"
    "Finds the rotation of camera B to camera A from what both see in the ball. A's alignment in\n"
    "the rig stands, B's is found. PATH is a JPEG or PNG picture, a folder of them: a sequence\n"
    "whose n-th pictures of both cameras are of the same moment, or a recording (.mcap) with\n"
    "pictures of the camera, of which common frame sets count. The rig's scene corrects parallax;\n"
    "without one, features find the rotation all the same, gradients and light only in wide "
    "rooms.\n"
    "\n";

constexpr const char* kRegisterNotes =
    "\n"
    "Methods: features (SIFT; cameras of the same kind, no start), gradients (edges; also thermal\n"
    "on colour; B's rotation in the rig is right to 9 degrees), light (sparks and melt pool of a\n"
    "sequence of at least 5 pictures, no start; then gradients). auto: features for cameras of "
    "the\n"
    "same kind, else light for folders, gradients for pictures. A rotation that is not sure is\n"
    "refused with the reason.\n"
    "\n"
    "A camera that the rig places by a pose is turned about the ball, which stays where its "
    "picture\n"
    "shows it: with -o its pose is replaced, rotation and position. Else outline and\n"
    "rotation_matrix are written. The rest of the rig file stays as it is.\n"
    "\n"
    "--json prints one object: method (the last one used), reference, camera, rotation_matrix "
    "[9],\n"
    "by rows: v_reference = R v_camera, rotation {yaw, pitch, roll} in degrees, outline {centre\n"
    "[u, v], radii [rx, ry] in pixels with centres at integers, angle}, residual_deg (rms of what\n"
    "both see), overlap (share of all directions that both show), inliers, sigma_deg [3] about "
    "the\n"
    "machine's X, Y, Z, direction_sigma_deg (rms over all directions, as `orbwatch place` states\n"
    "it), covariance [9] in square radians. Sigmas include B's outline where it is\n"
    "refined: always by gradients. Errors of A's outline, lenses and scene come on top.\n";

struct RegisterOptions {
  std::filesystem::path rig;
  std::filesystem::path out;
  align::RegistrationMethod method = align::RegistrationMethod::Auto;
  bool json = false;
  bool detect = false;
  bool refine_outline = false;
};

std::vector<Option> declare(RegisterOptions& o) {
  return {
      {"rig", 0, "FILE", "with both cameras, the ball and the scene", text_option(o.rig)},
      {"method", 0, "METHOD", "auto (default), features, gradients or light",
       word_option("method", align::kRegistrationMethods, o.method)},
      {"detect", 0, "", "B's outline from its first picture instead of the rig,\nrefined",
       flag_option(o.detect)},
      {"refine-outline", 0, "", "find B's outline, too: from some percent off, by features",
       flag_option(o.refine_outline)},
      {"json", 0, "", "for programs", flag_option(o.json)},
      {"output", 'o', "FILE", "rig file to write: RIG with what was found; may be RIG",
       text_option(o.out)},
  };
}

/// A camera of the rig whose pictures are of the rig's size.
Result<optics::RigCamera> camera_of(const optics::Rig& rig, const NamedPictures& named) {
  return find_camera(rig, named.name).and_then([&](const optics::RigCamera& camera) {
    return check_picture_size(named.pictures.front(), camera).map([&] { return camera; });
  });
}

Result<RegistrationSettings> settings_for(const RegisterOptions& o, const NamedPictures& sought) {
  RegistrationSettings settings{.method = o.method};
  if (o.detect || o.refine_outline) settings.outline_sigma = kFoundOutlineSigma;
  if (!o.detect) return settings;
  const auto ball = found_outline(sought.pictures.front().picture);
  if (!ball) return fail("camera " + sought.name + ": " + ball.error().message);
  settings.outline = ball->outline;
  return settings;
}

CliResult<std::string> register_cameras(const RegisterOptions& o, const std::string& first,
                                        const std::string& second) {
  if (o.rig.empty()) return usage_error("--rig is missing");
  const auto rig = files::load_rig(o.rig);
  if (!rig) return tl::unexpected(rig.error());
  const auto pictures = read_named_pictures({first, second});
  if (!pictures) return tl::unexpected(pictures.error());
  const auto& [a, b] = *pictures;
  if (a.name == b.name) return usage_error("camera " + a.name + " is given twice");
  const auto reference = camera_of(*rig, a);
  if (!reference) return tl::unexpected(reference.error());
  const auto sought = camera_of(*rig, b);
  if (!sought) return tl::unexpected(sought.error());
  const auto settings = settings_for(o, b);
  if (!settings) return tl::unexpected(settings.error());
  Progress progress;
  const align::WorkProgress shown([&](align::WorkStep step, double /*share*/) {
    progress.begin(std::string(operator_text(step)));
  });
  const auto found =
      register_camera(*rig, *reference, *sought, {a.views(), b.views()}, *settings, shown);
  progress.erase();
  if (!found) return fail(b.name + " on " + a.name + ": " + found.error().message);
  if (!o.out.empty()) {
    const auto written =
        files::write_aligned_rig(o.rig, {.cameras = {found->proposal.alignment}}, o.out);
    if (!written) return tl::unexpected(written.error());
  }
  const RegisteredCamera registered{a.name, b.name, found->found};
  return o.json ? register_json(registered) : register_text(registered);
}

}  // namespace

CliResult<std::string> register_command(const Arguments& arguments) {
  RegisterOptions o;
  return run_command(arguments,
                     {.usage = kRegisterUsage,
                      .options = declare(o),
                      .takes_words = true,
                      .notes = kRegisterNotes},
                     [&](const auto& words) -> CliResult<std::string> {
                       if (words.size() == 2) return register_cameras(o, words[0], words[1]);
                       return usage_error("name two cameras with their pictures, A=PATH B=PATH");
                     });
}

}  // namespace orbwatch::app::cli
