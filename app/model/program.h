#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/model/configuration_files.h"

namespace orbwatch::app {

class RecentLog;

/// What the program around an appliance has, for interfaces that show it; null: it has none.
struct Program {
  std::shared_ptr<ConfigurationFiles> files = nullptr;
  std::shared_ptr<const RecentLog> log = nullptr;
  std::vector<std::pair<std::string, std::string>> versions{};  ///< by name: its own, libraries'
  std::string commanders{};                                     ///< who may command, in words
};

/// That of the program itself; empty where there is none.
inline std::string version_of(const Program& program) {
  return program.versions.empty() ? "" : program.versions.front().second;
}

}  // namespace orbwatch::app
