// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/model/machine/machine_state.h"
#include "app/ports/dds/generated/machine_state.h"
#include "app/ports/dds/topics/topic_reader.h"

namespace orbwatch::app::dds {

using MachineStateMessage = orbwatch_msgs_msg_dds__MachineState_;

/// The state in a message. `written`: the sample's time stamp, s, which is its clock if it has
/// none. Error: the name of the part. Reentrant.
Result<MachineState> machine_state_of(const MachineStateMessage& message, double written);

/// Receives states of the machine and hands each over on the receive thread of DDS, which does not
/// wait for that. Thread rule: one owner.
class MachineStateReader {
 public:
  MachineStateReader(const std::string& prefix, MachinePath path);
  ~MachineStateReader() { close(); }

  /// Reads the topic until close(). Error: a failure of DDS.
  Result<> open(const Entity& participant);
  void close();
  bool is_open() const { return states_.get() > 0; }

  const TopicReader& states() const { return states_; }

 private:
  static void receive(dds_entity_t reader, void* self);

  const MachinePath path_;
  TopicReader states_;
};

}  // namespace orbwatch::app::dds
