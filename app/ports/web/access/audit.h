#pragma once

#include <cstddef>
#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include "app/ports/web/access/login_limits.h"

namespace orbwatch::app::web {

/// Who did what: lines of JSON in audit.jsonl of the state folder, and those before in
/// audit.1.jsonl. Only its owner reads them. Thread-safe; waits for the disk.
class Audit {
 public:
  /// Of a file, which then becomes the one before: a few thousand entries.
  static constexpr std::size_t kMostBytes = std::size_t{1} << 20;

  struct Entry {
    Utc time{};
    std::string who;   ///< name of a user or a token; empty: nobody by name
    std::string from;  ///< numeric address
    std::string what;  ///< of a command its name, else the route's
    std::string before{};
    std::string after{};
    std::string result;  ///< "done", or why not
  };

  /// Empty: nothing is kept.
  explicit Audit(std::filesystem::path state_folder) : folder_(std::move(state_folder)) {}

  /// Complains in the log when it cannot be kept.
  void note(const Entry& entry);

  /// `{"entries": [...]}` as JSON, the newest last. Lines that a power cut left in part are left
  /// out.
  std::string newest(std::size_t most) const;

 private:
  std::filesystem::path file() const { return folder_ / "audit.jsonl"; }
  std::filesystem::path file_before() const { return folder_ / "audit.1.jsonl"; }

  const std::filesystem::path folder_;
  mutable std::mutex mutex_;  ///< also while the disk is waited for
};

}  // namespace orbwatch::app::web
