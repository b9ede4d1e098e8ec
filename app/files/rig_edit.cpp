// SPDX-License-Identifier: Apache-2.0
#include "app/files/rig_edit.h"

#include <algorithm>
#include <cmath>

#include "app/files/camera_calibration.h"
#include "app/files/rig_file.h"
#include "app/files/text_file.h"
#include "app/files/toml_edit.h"
#include "app/files/toml_text.h"
#include "hal/atomic_file.h"

namespace orbwatch::app {
namespace {

/// New value of a key, or none to remove the key.
struct Value {
  const char* key;
  std::optional<std::string> text;
};

std::vector<Value> values(const CameraAlignment& alignment) {
  std::vector<Value> values;
  if (const auto& limb = alignment.outline) {
    values = {{"centre", toml_list({limb->centre.u, limb->centre.v})},
              {"radius", std::nullopt},
              {"radii", toml_list({limb->rx, limb->ry})},
              {"angle", toml_number(limb->angle)}};
  }
  if (alignment.registration) {
    values.push_back({"registered", std::nullopt});
    values.push_back({"rotation", std::nullopt});
    values.push_back({"rotation_matrix", toml_matrix(*alignment.registration)});
  }
  // The distance follows from the lens.
  if (alignment.intrinsics) {
    values.insert(values.end(), {{"alpha", std::nullopt}, {"distance", std::nullopt}});
  }
  return values;
}

std::vector<Value> values(const optics::Pose& pose) {
  return {{"position", toml_vector(pose.position)}, {"rotation", toml_matrix(pose.rotation)}};
}

Result<std::vector<Value>> values(const optics::Intrinsics& lens) {
  if (lens.distortion != optics::Distortion::None) {
    return fail("a lens with distortion belongs into a calibration file, not into the rig");
  }
  return std::vector<Value>{{"fx", toml_number(lens.fx)},
                            {"fy", toml_number(lens.fy)},
                            {"cx", toml_number(lens.cx)},
                            {"cy", toml_number(lens.cy)}};
}

/// Changes a camera's table `name` key by key, or adds it.
void change(TomlEdit& edit, const toml::table& camera, const std::string& name,
            const std::vector<Value>& values) {
  const toml::node* node = camera.get(name);
  if (const toml::table* table = node ? node->as_table() : nullptr; table && !table->is_inline()) {
    for (const Value& value : values) {
      value.text ? edit.set(*table, value.key, *value.text) : edit.remove(*table, value.key);
    }
    return;
  }
  edit.remove(camera, name);
  std::string lines = "\n[camera." + name + "]\n";
  for (const Value& value : values) {
    if (value.text) lines += std::string(value.key) + " = " + *value.text + "\n";
  }
  edit.append(camera, lines);
}

const toml::table* find_camera(const toml::table& root, const std::string& name) {
  const toml::array* cameras = root["camera"].as_array();
  if (!cameras) return nullptr;
  for (const toml::node& item : *cameras) {
    const toml::table* camera = item.as_table();
    if (camera && (*camera)["name"].value_or(std::string()) == name) return camera;
  }
  return nullptr;
}

Result<> change_camera(TomlEdit& edit, const CameraAlignment& alignment) {
  const toml::table* camera = find_camera(edit.root(), alignment.camera);
  if (!camera) return fail("there is no camera " + alignment.camera);
  if (alignment.intrinsics) {
    const auto lens = values(*alignment.intrinsics);
    if (!lens) return tl::unexpected(lens.error());
    edit.remove(*camera, "intrinsics");
    std::string lines = "\n[camera.intrinsics]\n";
    for (const Value& value : *lens) lines += std::string(value.key) + " = " + *value.text + "\n";
    edit.append(*camera, lines);
  }
  if (alignment.pose) {
    edit.remove(*camera, "outline");
    change(edit, *camera, "pose", values(*alignment.pose));
  } else if (alignment.outline || alignment.registration) {
    edit.remove(*camera, "pose");
    change(edit, *camera, "outline", values(alignment));
  }
  return {};
}

/// True if the text states the expected values, to 10 digits.
bool agrees(const optics::Mat3& a, const optics::Mat3& b) {
  const auto near = [](const optics::Vec3& x, const optics::Vec3& y) {
    return optics::norm(x - y) < 1e-8;
  };
  return near(a.row0, b.row0) && near(a.row1, b.row1) && near(a.row2, b.row2);
}

bool states(const optics::RigCamera& camera, const CameraAlignment& alignment) {
  const auto same = [](double a, double b) { return std::abs(a - b) <= 1e-8 * (1 + std::abs(b)); };
  if (alignment.pose) {
    return camera.pose && !camera.outline &&
           agrees(camera.pose->rotation, alignment.pose->rotation);
  }
  const auto& limb = alignment.outline;
  const bool outline = !limb || (camera.outline && same(camera.outline->rx, limb->rx) &&
                                 same(camera.outline->centre.u, limb->centre.u));
  return outline &&
         (!alignment.registration ||
          (camera.is_registered && agrees(camera.registration, *alignment.registration)));
}

/// Error for a camera whose tables have a notation that can only be changed by hand.
tl::unexpected<Error> not_changed(const std::string& name, const std::string& camera) {
  return fail(name + ": camera " + camera +
              " cannot be changed; write its tables with headers: [camera.outline], [camera.pose]");
}

}  // namespace

Result<std::string> aligned_rig(const std::string& text, const std::string& name,
                                const std::filesystem::path& folder,
                                const RigAlignment& alignment) {
  const auto before = parse_rig(text, name, folder);
  if (!before) return tl::unexpected(before.error());
  auto edit = TomlEdit::make(text, name);
  if (!edit) return tl::unexpected(edit.error());
  if (alignment.ball_centre) {
    const toml::table* ball = edit->root()["ball"].as_table();
    if (!ball) return fail(name + ": has no [ball], whose centre is to be set");
    edit->set(*ball, "centre", toml_vector(*alignment.ball_centre));
  }
  for (const CameraAlignment& camera : alignment.cameras) {
    const auto changed = change_camera(*edit, camera);
    if (!changed) return fail(name + ": " + changed.error().message);
  }
  std::string out = edit->text();
  const auto after = parse_rig(out, name + ", aligned", folder);
  if (!after) return tl::unexpected(after.error());
  for (const CameraAlignment& camera : alignment.cameras) {
    const auto found = std::ranges::find(after->cameras, camera.camera, &optics::RigCamera::name);
    if (found == after->cameras.end() || !states(*found, camera)) {
      return not_changed(name, camera.camera);
    }
  }
  return out;
}

Result<> write_aligned_rig(const std::filesystem::path& rig, const RigAlignment& alignment,
                           const std::filesystem::path& out) {
  TextFiles files;
  return files.read(rig, "a TOML file")
      .and_then([&](const std::string& text) {
        return aligned_rig(text, rig.string(), rig.parent_path(), alignment);
      })
      .and_then([&](const std::string& text) -> Result<> {
        // Paths in the rig are now relative to its new folder.
        const auto there = parse_rig(text, out.string(), out.parent_path());
        if (!there) return tl::unexpected(there.error());
        return hal::write_file(out, text, hal::FileAccess::Folder);
      });
}

}  // namespace orbwatch::app
