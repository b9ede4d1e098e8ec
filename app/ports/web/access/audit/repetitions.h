// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "app/ports/web/access/audit/audit_entry.h"

namespace orbwatch::app::web {

/// Keeps repetitions from filling the audit: the first few entries of one kind in an hour are
/// recorded individually, further ones are counted, and recorded together with their count. Memory
/// is bounded. Thread-bound.
class Repetitions {
 public:
  using Time = std::chrono::system_clock::time_point;

  static constexpr std::chrono::minutes kPeriod{60};
  /// Period after which a count is due.
  static constexpr std::chrono::minutes kReportPeriod{10};

  /// `free` entries of each kind are recorded individually. All kinds beyond `most_kinds` count as
  /// one.
  Repetitions(std::uint64_t free, std::size_t most_kinds) : free_(free), most_kinds_(most_kinds) {}

  struct Counted {
    bool is_noted = false;    ///< to be recorded individually
    std::uint64_t count = 0;  ///< entries of this kind within the period, including this one
  };
  /// Counts an entry; `kind` is not empty.
  Counted count(const std::string& kind, AuditEntry entry);

  /// Removes and returns entries with due counts. Each is the newest of its kind with the previous
  /// value of the oldest counted one; its result reads "done, 312 more".
  std::vector<AuditEntry> take_due(Time now);
  std::vector<AuditEntry> take_all();

 private:
  struct Kind {
    Time begun{};
    Time reported{};
    std::uint64_t count = 0;
    std::uint64_t more = 0;  ///< not recorded yet
    AuditEntry newest{};     ///< newest counted entry
  };

  using Kinds = std::map<std::string, Kind>;

  Kinds::iterator find(const std::string& name, Time now);
  static AuditEntry take(Kind& kind);

  const std::uint64_t free_;
  const std::size_t most_kinds_;
  Kinds kinds_;
};

}  // namespace orbwatch::app::web
