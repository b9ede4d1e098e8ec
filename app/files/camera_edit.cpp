// SPDX-License-Identifier: Apache-2.0
#include "app/files/camera_edit.h"

#include "app/files/toml/toml_edit.h"
#include "app/files/toml/toml_text.h"

namespace orbwatch::app::files {
namespace {

const toml::table* device_table(const toml::table& root, const std::string& name,
                                std::string_view back_end) {
  const toml::array* cameras = root["camera"].as_array();
  if (cameras == nullptr) return nullptr;
  for (const toml::node& item : *cameras) {
    const toml::table* camera = item.as_table();
    if (camera == nullptr || (*camera)["name"].value_or(std::string()) != name) continue;
    const toml::table* device = (*camera)[back_end].as_table();
    return device != nullptr && !device->is_inline() ? device : nullptr;
  }
  return nullptr;
}

}  // namespace

Result<std::string> with_camera_address(const std::string& text, const std::string& name,
                                        std::string_view back_end, std::string_view key,
                                        const std::string& address) {
  auto edit = TomlEdit::make(text, "the configuration");
  if (!edit) return tl::unexpected(edit.error());
  const toml::table* device = device_table(edit->root(), name, back_end);
  if (device == nullptr) {
    return fail("camera " + name + " has no table [camera." + std::string(back_end) + "]");
  }
  edit->set(*device, std::string(key), toml_string(address));
  return edit->finish();
}

}  // namespace orbwatch::app::files
