// SPDX-License-Identifier: Apache-2.0
#include "app/files/runtime/driven_lines.h"

#include <algorithm>
#include <string>
#include <system_error>

#include "app/files/toml/finding.h"
#include "app/files/toml/toml_reader.h"
#include "app/files/toml/toml_text.h"
#include "hal/atomic_file.h"
#include "hal/boot_id.h"
#include "hal/regular_file.h"

namespace orbwatch::app::files {
namespace {

namespace fs = std::filesystem;

/// Output with the settings that are needed to open it.
struct DrivenLine {
  std::string name;
  hal::OutputSettings output;
};

struct DrivenLines {
  std::string boot;
  std::vector<Located<DrivenLine>> lines;
};

template <class Visitor>
void visit(Visitor& v, DrivenLine& line) {
  hal::OutputSettings& output = line.output;
  v.required("name", line.name, "Name in the configuration");
  v.optional("line_name", output.address.name, "Same as in the configuration");
  v.optional("chip", output.address.chip, "Same as in the configuration");
  v.optional("offset", output.address.offset, Range::between(0, 65535),
             "Same as in the configuration");
  v.required("active_low", output.active_low, "Same as in the configuration");
  v.required("bias", output.bias, kLineBiases, "Same as in the configuration");
}

template <class Visitor>
void visit(Visitor& v, DrivenLines& driven) {
  v.required("boot", driven.boot, "The kernel's number of the board's start");
  v.tables("output", driven.lines, 0, 32, "GPIO outputs");
}

fs::path record_in(const fs::path& folder) { return folder / "driven-lines.toml"; }

std::string bias_word(hal::LineBias bias) {
  const auto found = std::ranges::find(kLineBiases, bias, &Word<hal::LineBias>::value);
  return std::string(found->name);
}

std::string text_of(const LineSettings& line) {
  const hal::LineAddress& address = line.wire.address;
  std::string text = "\n[[output]]\n" + toml_line("name", toml_string(line.name));
  if (address.name.empty()) {
    text += toml_line("chip", toml_string(address.chip)) +
            toml_line("offset", std::to_string(address.offset));
  } else {
    text += toml_line("line_name", toml_string(address.name));
  }
  return text + toml_line("active_low", line.wire.active_low ? "true" : "false") +
         toml_line("bias", toml_string(bias_word(line.wire.bias)));
}

LineSettings line_of(const DrivenLine& driven) {
  LineSettings line;
  line.name = driven.name;
  line.use = LineUse::ProcessOk;  // any use as an output
  line.wire.address = driven.output.address;
  line.wire.active_low = driven.output.active_low;
  line.wire.bias = driven.output.bias;
  return line;
}

}  // namespace

Result<> record_driven_lines(const fs::path& folder, const std::vector<LineSettings>& lines) {
  std::string text =
      "# GPIO outputs that orbwatchd drives, for `orbwatch lines --safe` after SIGKILL.\n" +
      toml_line("boot", toml_string(hal::boot_id()));
  for (const LineSettings& line : lines) {
    if (!is_input(line.use) && line.back_end == LineKind::Gpio) text += text_of(line);
  }
  auto written = hal::write_file(record_in(folder), text);
  if (!written) forget_driven_lines(folder);
  return written;
}

Result<std::optional<std::vector<LineSettings>>> driven_lines(const fs::path& folder) {
  const fs::path file = record_in(folder);
  std::error_code none;  // read_regular_file() reports the error
  if (!fs::exists(file, none) && !none) return std::nullopt;
  const auto text = hal::read_regular_file(file);
  if (!text) return tl::unexpected(text.error());
  Finding finding{file.string(), folder};
  DrivenLines driven;
  read_toml(*text, driven, finding);
  if (finding.message) return fail(*finding.message);
  if (driven.boot != hal::boot_id()) return std::nullopt;
  std::vector<LineSettings> lines;
  for (const DrivenLine& line : driven.lines) lines.push_back(line_of(line));
  return lines;
}

void forget_driven_lines(const fs::path& folder) {
  std::error_code none;
  fs::remove(record_in(folder), none);
}

}  // namespace orbwatch::app::files
