// SPDX-License-Identifier: Apache-2.0
#include "app/files/rig/rig_edit.h"

#include "app/files/rig/camera_calibration.h"
#include "app/files/rig/rig_file.h"
#include "app/files/text/text_file.h"
#include "app/files/toml/toml_edit.h"
#include "app/files/toml/toml_text.h"
#include "hal/atomic_file.h"

namespace orbwatch::app::files {
namespace {

/// New values of a camera's table, and the keys that it loses.
struct TableChange {
  std::vector<TomlValue> set;
  std::vector<const char*> removed;
};

TableChange outline_change(const CameraAlignment& alignment) {
  TableChange change;
  if (alignment.outline) change = {toml_values(*alignment.outline), {"radius"}};
  auto& removed = change.removed;
  if (alignment.registration) {
    change.set.push_back({"rotation_matrix", toml_matrix(*alignment.registration)});
    removed.insert(removed.end(), {"registered", "rotation"});
  }
  // The distance follows from the lens.
  if (alignment.intrinsics) removed.insert(removed.end(), {"alpha", "distance"});
  return change;
}

/// Replaces a camera's table `name`.
void replace(TomlEdit& edit, const toml::table& camera, const std::string& name,
             const std::vector<TomlValue>& values) {
  edit.remove(camera, name);
  edit.add_table(camera, "camera." + name, toml_lines(values));
}

/// Changes a camera's table `name` key by key, or adds it.
void change(TomlEdit& edit, const toml::table& camera, const std::string& name,
            const TableChange& change) {
  const toml::node* node = camera.get(name);
  const toml::table* table = node ? node->as_table() : nullptr;
  if (!table || table->is_inline()) return replace(edit, camera, name, change.set);
  for (const auto& [key, text] : change.set) edit.set(*table, key, text);
  for (const char* key : change.removed) edit.remove(*table, key);
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
    if (alignment.intrinsics->distortion != optics::Distortion::None) {
      return fail("a lens with distortion belongs into a calibration file, not into the rig");
    }
    replace(edit, *camera, "intrinsics", toml_values(*alignment.intrinsics));
  }
  if (alignment.pose) {
    edit.remove(*camera, "outline");
    change(edit, *camera, "pose", {toml_values(*alignment.pose), {}});
  } else if (alignment.outline || alignment.registration) {
    edit.remove(*camera, "pose");
    change(edit, *camera, "outline", outline_change(alignment));
  }
  return {};
}

}  // namespace

Result<std::string> aligned_rig(const std::string& text, const std::string& name,
                                const std::filesystem::path& folder,
                                const RigAlignment& alignment) {
  const auto before = parse_rig(text, name, folder, Unplaced::Allowed);
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
  return edit->finish().and_then([&](const std::string& out) {
    return parse_rig(out, name + ", aligned", folder, Unplaced::Allowed).map([&](const auto&) {
      return out;
    });
  });
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
        const auto there = parse_rig(text, out.string(), out.parent_path(), Unplaced::Allowed);
        if (!there) return tl::unexpected(there.error());
        return hal::write_file(out, text, hal::FileAccess::Folder);
      });
}

}  // namespace orbwatch::app::files
