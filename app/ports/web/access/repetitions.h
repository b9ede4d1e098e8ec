#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "app/ports/web/access/audit_entry.h"

namespace orbwatch::app::web {

/// Keeps repetitions from filling the audit: of entries of one kind the first few of an hour are
/// noted as they are, further ones are counted, and noted together with their count. Memory is
/// bounded. Thread-bound.
class Repetitions {
 public:
  using Time = std::chrono::system_clock::time_point;

  static constexpr std::chrono::minutes kPeriod{60};
  /// A count is due so long after the one before.
  static constexpr std::chrono::minutes kReportPeriod{10};

  /// `free` entries of each kind are noted as they are. Beyond `most_kinds` all further kinds count
  /// as one.
  Repetitions(std::uint64_t free, std::size_t most_kinds) : free_(free), most_kinds_(most_kinds) {}

  struct Counted {
    bool is_noted = false;    ///< is to be noted as it is
    std::uint64_t count = 0;  ///< of this kind within the period, this one included
  };
  /// `kind` is not empty.
  Counted count(const std::string& kind, AuditEntry entry);

  /// Entries with the counts that are due, or all that are not noted yet. Each is the newest of its
  /// kind with the value before the oldest counted one; its result says "done, 312 more".
  std::vector<AuditEntry> take_due(Time now);
  std::vector<AuditEntry> take_all();

 private:
  struct Kind {
    Time begun{};
    Time reported{};
    std::uint64_t count = 0;
    std::uint64_t more = 0;  ///< not noted yet
    AuditEntry newest{};     ///< counted one
  };

  using Kinds = std::map<std::string, Kind>;

  Kinds::iterator find(const std::string& name, Time now);
  static AuditEntry take(Kind& kind);

  const std::uint64_t free_;
  const std::size_t most_kinds_;
  Kinds kinds_;
};

}  // namespace orbwatch::app::web
