// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>
#include <string>

#include "app/files/configuration.h"
#include "app/files/recipe/recipe_file.h"
#include "app/files/rig/camera_calibration.h"
#include "app/files/rig/rig_file.h"
#include "app/files/toml/toml_reader.h"
#include "tests/fuzz/byte_stream.h"
#include "tests/fuzz/stop.h"

/// Any text as each of the files that users write: it is read, or refused in one line that names
/// the file. A calibration that is read can be written and read again.
///
/// An input is a byte that chooses the kind of file, and its text.
namespace orbwatch::fuzz {
namespace {

const std::string kName = "input";

void require_one_line(const std::string& message) {
  require(message.starts_with(kName), "refused without the file's name");
  const bool one_line =
      std::ranges::none_of(message, [](unsigned char c) { return std::iscntrl(c) != 0; });
  require(one_line, "refused in more than a line");
}

void read_site(const std::string& text) {
  app::files::Finding finding{kName, {}};
  app::files::Configuration site;
  app::files::read_toml(text, site, finding);
  if (finding.message) require_one_line(*finding.message);
}

void read_recipe(const std::string& text) {
  const auto recipe = app::files::parse_recipe(text, kName);
  if (!recipe) require_one_line(recipe.error().message);
}

void read_rig(const std::string& text) {
  const auto rig = app::files::parse_rig(text, kName, "/nonexistent");
  if (!rig) require_one_line(rig.error().message);
}

void read_calibration(const std::string& text) {
  const auto lens = app::files::parse_calibration(text, kName);
  if (!lens) return require_one_line(lens.error().message);
  for (const auto format :
       {app::files::CalibrationFormat::OpenCv, app::files::CalibrationFormat::Ros}) {
    const auto written = app::files::calibration_text(*lens, "camera", format);
    require(written.has_value(), "a calibration that was read is not written");
    const auto again = app::files::parse_calibration(*written, kName);
    require(again.has_value(), "a calibration that was written is not read");
  }
}

void run(ByteStream input) {
  const std::uint8_t kind = input.byte();
  const auto bytes = input.take(SIZE_MAX);
  const std::string text(bytes.begin(), bytes.end());
  switch (kind % 4) {
    case 0:
      return read_site(text);
    case 1:
      return read_recipe(text);
    case 2:
      return read_rig(text);
    default:
      return read_calibration(text);
  }
}

}  // namespace
}  // namespace orbwatch::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  orbwatch::fuzz::run(orbwatch::fuzz::ByteStream({data, size}));
  return 0;
}
