#include "app/daemon/dispatch.h"

namespace orbwatch::app {

CommandResult dispatch(const Command& command, const Receivers& receivers) {
  switch (command.code) {
    case CommandCode::Pulse:
      return receivers.lines.command(command);
    case CommandCode::Trigger: {
      // The result is the set that the pacing camera's trigger begins; without one, the next set.
      const bool begins_a_set = receivers.lines.triggers(receivers.pipeline.pacing_camera());
      const auto done = receivers.lines.command(command);
      return begins_a_set ? done : receivers.pipeline.command(command);
    }
    case CommandCode::Snapshot:
      if (!receivers.snapshots) return CommandResult::NotPossible;
      if (whole(command, 0) >= receivers.pipeline.view_count()) {
        return CommandResult::ArgumentOutOfRange;
      }
      return receivers.snapshots->command(command);
    case CommandCode::Restart:
      receivers.restart();
      return CommandResult::Done;
    default:
      return receivers.pipeline.command(command);
  }
}

}  // namespace orbwatch::app
