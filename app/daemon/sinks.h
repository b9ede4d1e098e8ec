#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/files/resolve.h"
#include "app/model/command.h"
#include "app/model/sink.h"
#include "app/state/command_record.h"

namespace orbwatch::app {

/// Who may command this appliance, in one line. Reentrant.
std::string commanders_text(const SinkSettings& sinks);

/// Makes every enabled sink of SinkSettings. Commands from outside go to `handler`, noted in
/// `record`.
std::vector<std::unique_ptr<Sink>> make_sinks(const Resolved& site, CommandHandler handler,
                                              std::shared_ptr<CommandRecord> record);

}  // namespace orbwatch::app
