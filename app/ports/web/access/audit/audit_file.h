// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "app/ports/web/access/audit/audit_entry.h"
#include "app/ports/web/api/json_form.h"

namespace orbwatch::app::web {

/// Audit entries on the disk, as lines of JSON: NAME.jsonl of the state folder and, once that was
/// full, the previous one, NAME.1.jsonl. Only their owner may read them. Thread-safe; waits for the
/// disk.
class AuditFile {
 public:
  /// Size at which a file becomes the previous one: a few thousand entries.
  static constexpr std::size_t kMostBytes = std::size_t{1} << 20;

  /// `state_folder` empty: nothing is recorded.
  AuditFile(std::filesystem::path state_folder, std::string name)
      : folder_(std::move(state_folder)), name_(std::move(name)) {}

  /// Appends entries; logs an error if they cannot be written.
  void append(const std::vector<AuditEntry>& entries);

  /// The newest entries as written, the newest last. Partial lines after a power cut are omitted.
  std::vector<Json> newest(std::size_t most) const;

 private:
  std::filesystem::path file() const { return folder_ / (name_ + ".jsonl"); }
  std::filesystem::path file_before() const { return folder_ / (name_ + ".1.jsonl"); }
  void append_lines(const std::string& lines);

  const std::filesystem::path folder_;
  const std::string name_;
  mutable std::mutex mutex_;  ///< held also while waiting for the disk
};

}  // namespace orbwatch::app::web
