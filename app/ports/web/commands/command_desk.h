// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/model/command/command_path.h"
#include "app/ports/web/access/access.h"
#include "app/ports/web/access/audit/audit.h"
#include "app/ports/web/api/route.h"
#include "app/ports/web/commands/command_runner.h"
#include "app/ports/web/views/view_list.h"

namespace orbwatch::app::web {

/// Executes commands and records them in the audit. Thread rule: as CommandRunner.
class CommandDesk {
 public:
  /// `views`, `access` and `audit` outlive the desk.
  CommandDesk(const CommandPath& path, const ViewList& views, Access& access, Audit& audit)
      : runner_(path.handler, path.record), views_(views), access_(access), audit_(audit) {}

  /// Answers a request later, once its command is executed.
  void run(const CommandInfo& info, const ExchangePtr& exchange);

  CommandRunner& runner() { return runner_; }
  const CommandRunner& runner() const { return runner_; }

 private:
  CommandRunner runner_;
  const ViewList& views_;
  Access& access_;
  Audit& audit_;
};

/// Route of a command, whose arguments are the members of its body. `desk` outlives it; null: the
/// route is only described.
Route command_route(const CommandInfo& info, CommandDesk* desk);

}  // namespace orbwatch::app::web
