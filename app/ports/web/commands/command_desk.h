// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "app/model/command/command_path.h"
#include "app/ports/web/access/access.h"
#include "app/ports/web/access/audit/audit.h"
#include "app/ports/web/api/route.h"
#include "app/ports/web/commands/command_runner.h"
#include "app/ports/web/views/view_list.h"
#include "app/state/command_record.h"

namespace orbwatch::app::web {

/// Executes commands and records them in the audit, with those of the other interfaces. Thread
/// rule: as CommandRunner; note_others on one thread at a time.
class CommandDesk {
 public:
  /// `views`, `access` and `audit` outlive the desk.
  CommandDesk(const CommandPath& path, const ViewList& views, Access& access, Audit& audit)
      : runner_(path.handler, path.record),
        record_(path.record),
        views_(views),
        access_(access),
        audit_(audit) {}

  /// Answers a request later, once its command is executed.
  void run(const CommandInfo& info, const ExchangePtr& exchange);

  /// Passes the commands of other interfaces, and the number of those that were lost, to the audit,
  /// which records them later. Does not wait.
  void note_others();

  CommandRunner& runner() { return runner_; }
  const CommandRunner& runner() const { return runner_; }

 private:
  void note_lost();

  CommandRunner runner_;
  const std::shared_ptr<CommandRecord> record_;
  const ViewList& views_;
  Access& access_;
  Audit& audit_;
  std::uint64_t noted_lost_ = 0;  ///< lost commands of which the audit knows
};

/// Route of a command, whose arguments are the members of its body. `desk` outlives it; null: the
/// route is only described.
Route command_route(const CommandInfo& info, CommandDesk* desk);

}  // namespace orbwatch::app::web
