#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "app/dds/entity.h"

namespace orbwatch::app {

/// Looks for writers and readers of others that use a topic of ours with another type: DDS never
/// connects them, and tells nobody. Thread-bound.
class TypeWatch {
 public:
  /// `types` by topic. Error: DDS refuses.
  Result<> open(const Entity& participant, std::map<std::string, std::string> types);
  void close();

  /// Logs those that are new, the first of each topic; returns how many were found since
  /// construction, after each open() anew.
  std::uint64_t look();

 private:
  void look(const Entity& reader, const char* kind);

  std::map<std::string, std::string> types_;
  std::map<std::string, std::uint64_t> found_;  ///< by topic
  std::uint64_t count_ = 0;
  Entity writers_;
  Entity readers_;
};

}  // namespace orbwatch::app
