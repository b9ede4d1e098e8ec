// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fstream>
#include <string>

#include "app/files/resolve.h"
#include "tests/app/files/replaced.h"
#include "tests/support/temporary_folder.h"

/// Files of a small machine, which tests change.
namespace orbwatch::app::files {

inline const std::string kRig = R"(
[[camera]]
name = "a"
width = 100
height = 80
[camera.outline]
centre = [50, 40]
radius = 30
alpha = 340

[[camera]]
name = "spare"
width = 320
height = 256
[camera.outline]
centre = [160, 128]
radius = 90
distance = 9
)";

inline const std::string kValid = R"(
rig = "rig.toml"
[[camera]]
name = "a"
back_end = "replay"
[camera.replay]
source = "pictures"

[[view]]
name = "front"
width = 64
height = 48
[[view.source]]
camera = "a"
)";

inline std::string replaced(const std::string& what, const std::string& with) {
  return replaced(what, with, kValid);
}

/// Files of a machine: the rig beside the configuration, and a broken one.
class ConfigurationFile : public testing::Test {
 protected:
  ConfigurationFile() {
    std::ofstream(folder / "rig.toml") << kRig;
    std::ofstream(folder / "broken.toml") << replaced("alpha = 340", "alpha = 180", kRig);
  }
  Result<Resolved> parse(const std::string& text) const {
    return resolve_text(text, "site.toml", folder.path());
  }

  orbwatch::tests::TemporaryFolder folder;
};

inline const std::string kLines = R"(
[[line]]
name = "start"
use = "trigger_in"
line_name = "TRIGGER_IN"
debounce_us = 50
[[line]]
name = "flash"
use = "strobe"
chip = "pinctrl"
offset = 4
source = "start"
width_us = 200
)";

}  // namespace orbwatch::app::files
