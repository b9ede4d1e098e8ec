// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "app/model/command/command.h"

namespace orbwatch::app {

class CommandRecord;

/// The way of commands from an interface to their execution.
struct CommandPath {
  CommandHandler handler;                 ///< executes them
  std::shared_ptr<CommandRecord> record;  ///< of those that go to `handler`
};

}  // namespace orbwatch::app
