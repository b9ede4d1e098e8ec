// SPDX-License-Identifier: Apache-2.0
#include "app/cli/dds/received_state.h"

#include <algorithm>
#include <cstring>
#include <string_view>
#include <utility>

#include "app/ports/dds/participant/dds_log.h"
#include "app/ports/dds/participant/time_message.h"
#include "app/ports/dds/topics/topic_names.h"

namespace orbwatch::app::cli {
namespace {

// Errors do not quote the sender, whose text may contain control characters.

Result<> check_length(std::size_t length, std::string_view what) {
  if (length <= kMaxListLength) return {};
  return fail("process state: " + std::to_string(length) + " " + std::string(what) + ", at most " +
              std::to_string(kMaxListLength) + " are accepted");
}

Result<std::string_view> checked_text(const char* text) {
  const std::size_t length = ::strnlen(text, kMaxTextLength + 1);
  if (length <= kMaxTextLength) return std::string_view(text, length);
  return fail("process state: a text of more than " + std::to_string(kMaxTextLength) + " bytes");
}

Result<std::string_view> checked_word(const char* text, std::string_view what) {
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  return checked_text(text).and_then([&](std::string_view word) -> Result<std::string_view> {
    if (!word.empty() && std::ranges::all_of(word, is_letter)) return word;
    return fail("process state: the " + std::string(what) + " is not snake_case");
  });
}

Result<Reading> checked_figure(const dds::FigureMessage& figure) {
  const auto name = checked_word(figure.name, "name of a figure");
  if (!name) return tl::unexpected(name.error());
  const auto unit = checked_text(figure.unit);
  if (!unit) return tl::unexpected(unit.error());
  const auto text = checked_text(figure.text);
  if (!text) return tl::unexpected(text.error());
  return Reading{*name, figure.value, *unit, *text};
}

Result<ComponentReadings> checked_component(const dds::ComponentMessage& message) {
  const auto kind = checked_word(message.kind, "kind of a component");
  if (!kind) return tl::unexpected(kind.error());
  const auto name = checked_text(message.name);
  if (!name) return tl::unexpected(name.error());
  if (const auto checked = check_length(message.figures._length, "figures"); !checked) {
    return tl::unexpected(checked.error());
  }
  ComponentReadings component{{*kind, std::string(*name)}, {}};
  for (std::uint32_t i = 0; i < message.figures._length; ++i) {
    const auto figure = checked_figure(message.figures._buffer[i]);
    if (!figure) return tl::unexpected(figure.error());
    component.readings.push_back(*figure);
  }
  return component;
}

}  // namespace

Result<ReceivedState> check_process_state(const dds::ProcessStateMessage& message) {
  const auto system_state = static_cast<SystemState>(message.system_state);
  if (operator_text(system_state).empty()) {
    return fail("process state: system state " + std::to_string(message.system_state) +
                " is unknown");
  }
  if (const auto checked = check_length(message.components._length, "components"); !checked) {
    return tl::unexpected(checked.error());
  }
  ReceivedState state{dds::to_utc(message.header.stamp),
                      message.frame_set,
                      message.trigger,
                      message.result,
                      message.recipe,
                      message.configuration_checksum,
                      system_state,
                      message.heartbeat,
                      {}};
  for (std::uint32_t i = 0; i < message.components._length; ++i) {
    auto component = checked_component(message.components._buffer[i]);
    if (!component) return tl::unexpected(component.error());
    state.components.push_back(std::move(*component));
  }
  return state;
}

StateReader::StateReader(const std::string& prefix)
    : states_(orbwatch_msgs_msg_dds__ProcessState__desc, dds::process_state_topic(prefix)) {}

Result<> StateReader::open(int domain, const std::optional<dds::SecuritySettings>& security) {
  dds::limit_dds_log();
  auto participant = dds::Participant::join(domain, security);
  if (!participant) return tl::unexpected(participant.error());
  participant_ = std::move(*participant);
  return states_.open(participant_.entity(), dds::state_qos())
      .and_then([&] { return make_wait_set(participant_.entity(), {states_.get()}); })
      .map([&](dds::Entity wait_set) { wait_set_ = std::move(wait_set); });
}

Result<bool> StateReader::next(std::chrono::nanoseconds timeout, const AcceptState& accept) {
  bool accepted = false;
  // The topic has one instance and a history of one: there is at most one sample.
  const auto look = [&](const void* sample, const dds_sample_info_t&) {
    const auto state = check_process_state(*static_cast<const dds::ProcessStateMessage*>(sample));
    if (state) {
      accept(*state);
      accepted = true;
    } else {
      refusal_ = state.error().message;
    }
  };
  const auto taken = wait_for_data(wait_set_, timeout).and_then([&](bool) {
    return dds::take_samples(states_.get(), look);
  });
  if (!taken) return tl::unexpected(taken.error());
  return accepted;
}

}  // namespace orbwatch::app::cli
