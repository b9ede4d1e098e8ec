// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "app/model/status/alarm_notice.h"
#include "app/model/status/status_report.h"

/// Messages of recordings, member by member as in app/ports/dds/idl, for hal/mcap/cdr.h.
namespace orbwatch::app::recorder {

using Utc = std::chrono::system_clock::time_point;

/// std_msgs/msg/Header.
struct Header {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  std::string frame_id;

  template <class Self, class Fields>
  static auto visit(Self& self, Fields& fields) {
    return fields(self.sec, self.nanosec, self.frame_id);
  }
};

/// orbwatch_msgs/msg/Figure.
struct Figure {
  std::string name;
  double value = 0;
  std::string unit, text;

  template <class Self, class Fields>
  static auto visit(Self& self, Fields& fields) {
    return fields(self.name, self.value, self.unit, self.text);
  }
};

/// orbwatch_msgs/msg/Component.
struct ComponentFigures {
  std::string kind, name;
  std::vector<Figure> figures;

  template <class Self, class Fields>
  static auto visit(Self& self, Fields& fields) {
    return fields(self.kind, self.name, self.figures);
  }
};

/// orbwatch_msgs/msg/ProcessState.
struct ProcessState {
  Header header;
  std::uint64_t frame_set = 0, trigger = 0, result = 0;
  std::uint16_t recipe = 0;
  std::uint32_t configuration_checksum = 0;
  std::uint8_t system_state = 0;
  std::uint64_t heartbeat = 0;
  std::vector<ComponentFigures> components;

  template <class Self, class Fields>
  static auto visit(Self& self, Fields& fields) {
    return fields(self.header, self.frame_set, self.trigger, self.result, self.recipe,
                  self.configuration_checksum, self.system_state, self.heartbeat, self.components);
  }
};

/// orbwatch_msgs/msg/Event.
struct EventMessage {
  Header header;
  std::uint64_t number = 0;
  std::string kind = "alarm", source;
  std::uint8_t severity = 0;
  std::string text;
  std::vector<Figure> figures;

  template <class Self, class Fields>
  static auto visit(Self& self, Fields& fields) {
    return fields(self.header, self.number, self.kind, self.source, self.severity, self.text,
                  self.figures);
  }
};

/// The components of what was measured: system, regions, alarms, machine. Reentrant.
ProcessState process_state_of(const StatusReport& report);

/// Reentrant.
EventMessage event_of(const AlarmNotice& notice, const StatusNames& names, Utc stamp);

}  // namespace orbwatch::app::recorder
