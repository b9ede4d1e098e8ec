// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "app/ports/dds/participant/entity.h"

namespace orbwatch::app::dds {

/// Detects foreign writers and readers that use a topic of ours with another type: DDS never
/// matches them, without an error. Thread-bound.
class TypeWatch {
 public:
  /// Starts watching `types`, by topic. Error: a failure of DDS.
  Result<> open(const Entity& participant, std::map<std::string, std::string> types);
  void close();

  /// Logs the first one of each topic; returns the number detected since construction. After open()
  /// all present ones are detected again.
  std::uint64_t update();

 private:
  void update(const Entity& reader, const char* kind);

  std::map<std::string, std::string> types_;
  std::map<std::string, std::uint64_t> found_;  ///< counts by topic
  std::uint64_t count_ = 0;
  Entity writers_;
  Entity readers_;
};

}  // namespace orbwatch::app::dds
