// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/model/fleet/fleet.h"

/// Records of the appliances of the DDS domain.
namespace orbwatch::app::web {

/// One appliance of the domain.
struct SentAppliance {
  std::string id, name;
  bool is_self = false, is_gone = false;
  double age = 0;
  std::optional<std::string> newest;
  SystemState state = SystemState::Starting;
  std::string condition;
  int severity = 0;
  std::uint32_t alarms = 0;
  std::string alarm;
  int alarm_severity = 0;
  std::string version, prefix;
  std::optional<std::string> page;
  std::uint64_t pictures = 0;
};
template <class Visitor>
void visit(Visitor& v, SentAppliance& appliance) {
  v.required("id", appliance.id, "Unique for one run of one appliance");
  v.required("name", appliance.name, "For display; not unique");
  v.required("is_self", appliance.is_self, "This appliance");
  v.required("is_gone", appliance.is_gone, "It has fallen silent");
  v.required("age", appliance.age, "Time since its newest notice", "s");
  v.required("newest", appliance.newest, "Time of its newest notice, UTC");
  v.required("state", appliance.state, "State of the appliance");
  v.required("condition", appliance.condition, "State in words");
  v.required("severity", appliance.severity,
             "Severity of the condition: 0 good, 1 warning, 2 fault");
  v.required("alarms", appliance.alarms, "Number of active alarms");
  v.required("alarm", appliance.alarm, "The worst active alarm");
  v.required("alarm_severity", appliance.alarm_severity, "Severity of that alarm");
  v.required("version", appliance.version, "Version of orbwatch");
  v.required("prefix", appliance.prefix, "Prefix of its topics");
  v.required("page", appliance.page, "Address of its page; null: served to its own computer only");
  v.required("pictures", appliance.pictures, "Thumbnails received; 0: there is none");
}
/// Reentrant.
std::vector<SentAppliance> sent_appliances(const std::vector<Fleet::Entry>& entries,
                                           hal::TimePoint now);

struct FleetAnswer {
  std::vector<SentAppliance> appliances;
  std::uint64_t turned_away = 0, refused = 0;
  std::optional<std::string> missing;
};
template <class Visitor>
void visit(Visitor& v, FleetAnswer& answer) {
  v.required("appliances", answer.appliances, "By name");
  v.required("turned_away", answer.turned_away, "Notices of appliances beyond the limit");
  v.required("refused", answer.refused, "Invalid notices and thumbnails");
  v.required("missing", answer.missing, "What the list needs; null: nothing");
}

struct ThumbnailQuery {
  std::string appliance;
};
template <class Visitor>
void visit(Visitor& v, ThumbnailQuery& query) {
  v.required("appliance", query.appliance, "Id of the appliance in the list");
}

struct ForgottenAnswer {
  std::size_t forgotten = 0;
};
template <class Visitor>
void visit(Visitor& v, ForgottenAnswer& answer) {
  v.required("forgotten", answer.forgotten, "Number of appliances removed from the list");
}

}  // namespace orbwatch::app::web
