// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

/// The folders of the architecture: who may include whom.
namespace orbwatch::tests {

/// Headers that the files of a folder may include.
struct Rule {
  std::string folder;                ///< files below it ...
  std::vector<std::string> allowed;  ///< ... include our headers in these folders or files only,
                                     ///< where * is any part of a path,
  std::vector<std::string> foreign;  ///< and libraries whose headers start like this
};

/// A port sees the model and its own folder, never another port.
inline std::vector<std::string> port(const std::string& folder) {
  return {"proc",         "hal",       "app/model",        "app/log.h", "app/recent_log.h",
          "app/pictures", "app/state", "app/certificates", folder};
}

/// The most specific rule counts. The standard library and the C library are allowed everywhere.
inline const std::vector<Rule> kRules{
    {"proc/image", {"proc/image"}, {"tl/expected"}},
    {"proc/settings", {"proc/settings"}, {}},
    {"proc/optics", {"proc/image", "proc/settings", "proc/optics"}, {"tl/expected"}},
    {"proc/remap", {"proc/image", "proc/settings", "proc/optics", "proc/remap"}, {"tl/expected"}},
    {"proc/signals",
     {"proc/image", "proc/settings", "proc/optics", "proc/signals"},
     {"tl/expected", "opencv2/"}},
    {"proc/align",
     {"proc/image", "proc/settings", "proc/optics", "proc/align"},
     {"tl/expected", "apriltag/", "opencv2/", "ceres/", "Eigen/"}},
    {"hal", {"proc/image", "proc/settings", "hal"}, {"tl/expected", "gpiod", "linux/"}},
    {"hal/genicam",
     {"proc/image", "proc/settings", "hal"},
     {"tl/expected", "arv.h", "arpa/", "netinet/"}},
    {"hal/jpeg", {"proc/image", "proc/settings", "hal"}, {"tl/expected", "jpeglib", "jerror"}},
    {"hal/libcamera",
     {"proc/image", "proc/settings", "hal"},
     {"tl/expected", "libcamera/", "linux/"}},
    {"hal/png", {"proc/image", "hal/png"}, {"tl/expected", "png.h"}},
    {"hal/mosaic", {"proc/image", "hal/mosaic"}, {"tl/expected", "opencv2/"}},
    {"hal/video", {"proc/image", "proc/settings", "hal"}, {"tl/expected", "opencv2/"}},
    {"app",
     {"hal", "app/exit_status.h", "app/log.h", "app/log_writer.h", "app/recent_log.h",
      "app/version.h"},
     {"tl/expected"}},
    {"app/model", {"proc", "hal", "app/model"}, {"tl/expected", "nlohmann/"}},
    {"app/alignment",
     {"proc", "hal", "app/alignment", "app/model", "app/log.h", "app/pictures",
      "app/pipeline/views"},
     {"tl/expected"}},
    {"app/watch",
     {"proc", "hal", "app/watch", "app/model", "app/log.h", "app/pictures", "app/alignment"},
     {"opencv2/", "tl/expected"}},
    {"app/files",
     {"proc", "hal", "app/files", "app/model", "app/state", "app/pipeline/*_settings.h",
      "app/pipeline/measurement/recipe.h", "app/pipeline/views/picture_use.h",
      "app/ports/*_settings.h", "app/simulation/*_settings.h", "app/simulation/machine.h",
      "app/machine/machine_settings.h"},
     {"nlohmann/", "toml++/", "yaml-cpp/", "tl/expected"}},
    {"app/daemon",
     {"proc",
      "hal",
      "app/daemon",
      "app/model",
      "app/exit_status.h",
      "app/log.h",
      "app/log_writer.h",
      "app/recent_log.h",
      "app/version.h",
      "app/pictures",
      "app/state",
      "app/certificates",
      "app/health",
      "app/service",
      "app/simulation",
      "app/pipeline",
      "app/alignment",
      "app/watch",
      "app/machine",
      "app/files",
      "app/ports"},
     {"opencv2/", "tl/expected"}},
    {"app/ports/console", port("app/ports/console"), {"tl/expected"}},
    {"app/ports/lines", port("app/ports/lines"), {"tl/expected"}},
    {"app/ports/snapshot", port("app/ports/snapshot"), {"tl/expected"}},
    {"app/cli", {"proc", "hal", "app"}, {"nlohmann/", "opencv2/", "dds/", "tl/expected"}},
    {"app/ports/dds", port("app/ports/dds"), {"dds/", "tl/expected"}},
    {"app/ports/dds/generated", {"app/ports/dds/generated", "dds"}, {}},
    {"app/ports/dds/security",
     {"proc/image", "hal", "app/certificates", "app/ports/dds"},
     {"dds/", "openssl/", "tl/expected"}},
    {"app/ports/web", port("app/ports/web"), {"nlohmann/", "tl/expected"}},
    {"app/ports/web/access", port("app/ports/web"), {"nlohmann/", "sodium.h", "tl/expected"}},
    {"app/ports/web/http",
     {"proc/image", "proc/settings", "hal", "app/ports/web/http", "app/ports/web/web_settings.h"},
     {"microhttpd.h", "nlohmann/", "tl/expected"}},
    {"app/ports/web/status", port("app/ports/web"), {"nlohmann/", "prometheus/", "tl/expected"}},
    {"app/certificates", {"proc/image", "hal", "app/certificates"}, {"openssl/", "tl/expected"}},
    {"app/pictures",
     {"proc", "hal", "app/pictures"},
     {"opencv2/", "png.h", "turbojpeg", "tl/expected"}},
    {"app/ports/modbus", port("app/ports/modbus"), {"modbus/", "tl/expected"}},
    {"app/ports/modbus/map",
     {"proc", "hal", "app/model", "app/ports/modbus/map", "app/ports/modbus/modbus_settings.h",
      "app/state"},
     {"tl/expected"}},
    {"app/ports/modbus/server",
     {"proc", "hal", "app/ports/modbus/map", "app/ports/modbus/server",
      "app/ports/modbus/modbus_settings.h"},
     {"modbus/", "tl/expected"}},
    {"app/pipeline",
     {"proc", "hal", "app/model", "app/pipeline", "app/pictures/colour_maps.h", "app/log.h"},
     {"tl/expected"}},
    {"app/machine", {"proc", "hal", "app/machine", "app/model", "app/log.h"}, {"tl/expected"}},
    {"app/simulation", {"proc", "hal", "app/simulation", "app/model/machine"}, {"tl/expected"}},
    {"app/service",
     {"proc", "hal", "app/model", "app/service", "app/log.h", "app/log_writer.h"},
     {"systemd/", "tl/expected"}},
    {"app/state", {"proc", "hal", "app/model", "app/log.h", "app/state"}, {"tl/expected"}},
    {"app/health", {"proc", "hal", "app/model", "app/health", "app/log.h"}, {"tl/expected"}},
};

}  // namespace orbwatch::tests
