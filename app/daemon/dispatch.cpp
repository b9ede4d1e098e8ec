// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/dispatch.h"

namespace orbwatch::app::daemon {
namespace {

/// A result is the frame set that begins with the pacing camera's trigger; without a trigger line,
/// the next frame set.
CommandResult trigger(const Receivers& receivers) {
  const bool begins_a_set = receivers.lines.triggers(receivers.pipeline.pacing_camera());
  receivers.lines.trigger();
  return begins_a_set ? CommandResult::Done : receivers.pipeline.trigger();
}

CommandResult snapshot(const Receivers& receivers, std::size_t view) {
  if (!receivers.snapshots) return CommandResult::NotPossible;
  if (view >= receivers.pipeline.view_count()) return CommandResult::ArgumentOutOfRange;
  return receivers.snapshots->request(view);
}

CommandResult record_event(RecorderSink* recorder) {
  return recorder && recorder->request_event() ? CommandResult::Done : CommandResult::NotPossible;
}

CommandResult learn_clean_ball(CameraWatch& watch, std::size_t camera) {
  if (!watch.is_watched(camera)) return CommandResult::ArgumentOutOfRange;
  watch.learn_clean_ball(camera);
  return CommandResult::Done;
}

CommandResult restart(const Receivers& receivers) {
  if (!receivers.restart.check()) return CommandResult::NotPossible;
  receivers.restart.request();
  return CommandResult::Done;
}

}  // namespace

CommandResult dispatch(const Command& command, const Receivers& receivers) {
  pipeline::Pipeline& pipeline = receivers.pipeline;
  const auto& arguments = command.arguments;
  // Without a default the compiler refuses a command without a handler.
  switch (command.code) {
    case CommandCode::SelectView:
      return pipeline.select_view(command.integer(0));
    case CommandCode::Pulse:
      return receivers.lines.pulse(command.integer(0));
    case CommandCode::Start:
      return pipeline.start_measuring();
    case CommandCode::Stop:
      return pipeline.stop_measuring();
    case CommandCode::SelectRecipe:
      return pipeline.select_recipe(command.integer(0));
    case CommandCode::PointView:
      return pipeline.point_view(command.integer(0), arguments[1], arguments[2], arguments[3]);
    case CommandCode::MixSources:
      return pipeline.mix_sources(command.integer(0), command.integer(1), arguments[2]);
    case CommandCode::Trigger:
      return trigger(receivers);
    case CommandCode::AcknowledgeAlarm:
      return pipeline.acknowledge_alarm(command.integer(0), command.giver);
    case CommandCode::Snapshot:
      return snapshot(receivers, command.integer(0));
    case CommandCode::SetProcessActive:
      return pipeline.set_process_active(command.integer(0) == 1);
    case CommandCode::Restart:
      return restart(receivers);
    case CommandCode::DetectBall:
      return receivers.alignment.detect(command.integer(0));
    case CommandCode::RegisterCamera:
      return receivers.alignment.register_to_first(command.integer(0));
    case CommandCode::CorrectAlignment:
      return receivers.alignment.correct(command.integer(0));
    case CommandCode::AcceptAlignment:
      return receivers.alignment.accept(command.integer(0));
    case CommandCode::DiscardAlignment:
      return receivers.alignment.discard(command.integer(0));
    case CommandCode::LearnCleanBall:
      return learn_clean_ball(receivers.watch, command.integer(0));
    case CommandCode::MarkPoint:
      return receivers.alignment.mark(command.integer(0),
                                      {arguments[1], arguments[2], arguments[3]});
    case CommandCode::ForgetPoints:
      return receivers.alignment.forget_points(command.integer(0));
    case CommandCode::PlaceCamera:
      return receivers.alignment.place(command.integer(0));
    case CommandCode::MoveOutline:
      return receivers.alignment.move_outline(command.integer(0), {arguments[1], arguments[2]});
    case CommandCode::ShapeOutline:
      return receivers.alignment.shape_outline(command.integer(0), arguments[1], arguments[2],
                                               arguments[3]);
    case CommandCode::TurnCamera:
      return receivers.alignment.turn(command.integer(0),
                                      {arguments[1], arguments[2], arguments[3]});
    case CommandCode::UndoAlignment:
      return receivers.alignment.undo(command.integer(0));
    case CommandCode::RevertAlignment:
      return receivers.alignment.revert(command.integer(0));
    case CommandCode::PickPixel:
      return receivers.alignment.pick(command.integer(0), {arguments[1], arguments[2]});
    case CommandCode::SetColourMap:
      return pipeline.set_colour_map(command.integer(0), command.integer(1), command.integer(2));
    case CommandCode::SetColourRange:
      return pipeline.set_colour_range(command.integer(0), command.integer(1),
                                       {arguments[2], arguments[3]});
    case CommandCode::ForgetPoint:
      return receivers.alignment.forget_point(command.integer(0),
                                              {arguments[1], arguments[2], arguments[3]});
    case CommandCode::CancelAlignment:
      return receivers.alignment.cancel(command.integer(0));
    case CommandCode::RecordEvent:
      return record_event(receivers.recorder);
  }
  return CommandResult::UnknownCommand;
}

}  // namespace orbwatch::app::daemon
