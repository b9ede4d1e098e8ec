// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/machine/machine_state_reader.h"

#include <utility>

#include "app/ports/dds/topics/topic_names.h"

namespace orbwatch::app::dds {

Result<MachineState> machine_state_of(const MachineStateMessage& message, double written) {
  const auto part = PartName::make(message.part);
  if (!part) return tl::unexpected(part.error());
  MachineState state{.sequence = message.number, .clock = message.clock, .part = *part};
  if (!signals::is_valid(state.clock)) state.clock = written;
#define ORBWATCH_TAKE(name, ...) state.values.name = message.name;
  ORBWATCH_MACHINE_VALUES(ORBWATCH_TAKE)
#undef ORBWATCH_TAKE
  return state;
}

MachineStateReader::MachineStateReader(const std::string& prefix, MachinePath path)
    : path_(std::move(path)),
      states_(orbwatch_msgs_msg_dds__MachineState__desc, machine_state_topic(prefix)) {}

Result<> MachineStateReader::open(const Entity& participant) {
  show_order_of_calls();
  const Listener listener(dds_create_listener(this));
  dds_lset_data_available(listener.get(), receive);
  return states_.open(participant, machine_state_qos(), listener.get());
}

void MachineStateReader::close() {
  states_.close();
  show_order_of_calls();
}

void MachineStateReader::receive(dds_entity_t reader, void* self) {
  const MachinePath& path = static_cast<MachineStateReader*>(self)->path_;
  show_order_of_calls();
  const auto take = [&path](const void* sample, const dds_sample_info_t& info) {
    const double written = 1e-9 * static_cast<double>(info.source_timestamp);
    // The path counts and logs a refusal.
    static_cast<void>(
        path.take(machine_state_of(*static_cast<const MachineStateMessage*>(sample), written)));
  };
  take_all_samples(reader, take);
  show_order_of_calls();
}

}  // namespace orbwatch::app::dds
