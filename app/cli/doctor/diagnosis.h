// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "proc/settings/settings.h"

namespace orbwatch::app::cli::doctor {

enum class Level : std::uint8_t {
  Ok,
  Warning,  ///< orbwatchd runs, with a risk or a limitation
  Fault,    ///< orbwatchd does not do what its configuration requires
};

inline constexpr std::array kLevels{Word{"ok", Level::Ok}, Word{"warning", Level::Warning},
                                    Word{"fault", Level::Fault}};

/// Result of one check.
struct Diagnosis {
  std::string check{};  ///< name of the check
  Level level = Level::Ok;
  std::string text{};    ///< may quote devices and files
  std::string remedy{};  ///< command that corrects it, or the action if no command does; empty: ok
};
using Diagnoses = std::vector<Diagnosis>;

inline Diagnosis ok(std::string text) { return {.text = std::move(text)}; }
inline Diagnosis warning(std::string text, std::string remedy) {
  return {.level = Level::Warning, .text = std::move(text), .remedy = std::move(remedy)};
}
inline Diagnosis fault(std::string text, std::string remedy) {
  return {.level = Level::Fault, .text = std::move(text), .remedy = std::move(remedy)};
}

}  // namespace orbwatch::app::cli::doctor
