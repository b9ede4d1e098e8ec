// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/model/command/command_path.h"
#include "app/model/fleet/appliance_notice.h"
#include "app/model/machine/machine_state.h"
#include "app/model/sink/published.h"
#include "app/model/sink/sink.h"
#include "app/model/status/status_report.h"
#include "app/pictures/jpeg_quality.h"
#include "app/ports/dds/ros/ros_node.h"
#include "app/ports/dds/security/participant_security.h"
#include "hal/thread/shared_threads.h"
#include "proc/settings/settings.h"

namespace orbwatch::app {

class Fleet;

/// The [dds] part of the site file.
struct DdsSettings {
  static constexpr std::string_view kName = "dds",
                                    kText = "DDS participant for the machine controller";

  bool enabled = true;
  int domain = 0;                   ///< DDS domain, ROS_DOMAIN_ID of ROS 2; 0 to 230
  std::string prefix = "orbwatch";  ///< topics are rt/<prefix>/...
  std::string name{};               ///< name in the fleet list; empty: the host name
  /// Nullopt: every participant of the domain is admitted.
  std::optional<dds::SecuritySettings> security{};
  std::optional<bool> commands{};  ///< accept commands; nullopt: only with security
  JpegSettings jpeg{};
  /// Cyclone DDS' network settings, such as interfaces and peers; empty: those of CYCLONEDDS_URI.
  std::filesystem::path profile{};
  dds::RosGeneration ros = dds::RosGeneration::Iron;
};

inline bool takes_commands(const DdsSettings& dds) {
  return dds.enabled && dds.commands.value_or(dds.security.has_value());
}

inline constexpr std::array kRosGenerations{Word{"humble", dds::RosGeneration::Humble},
                                            Word{"iron", dds::RosGeneration::Iron}};

template <class Visitor>
void visit(Visitor& v, DdsSettings& dds) {
  v.optional("enabled", dds.enabled, "Publish views and process state over DDS");
  v.optional("domain", dds.domain, Range::between(0, 230), "DDS domain; ROS_DOMAIN_ID in ROS 2");
  v.optional("prefix", dds.prefix, "Prefix of the topics: rt/<prefix>/...");
  v.optional("name", dds.name, "This appliance's name in the fleet list; default: the host name");
  v.require(dds.name.size() <= ApplianceIdentity::kLongestName, "name",
            "has more than 64 bytes; set a shorter name");
  v.optional("profile", dds.profile,
             "Cyclone DDS network profile, as in platform/dds; default: the one that "
             "CYCLONEDDS_URI names");
  v.optional("ros", dds.ros, kRosGenerations,
             "Generation of the ROS 2 graph in which the node orbwatch is announced: iron for Iron "
             "and later");
  v.optional("commands", dds.commands,
             "Accept commands over DDS; default: only with [dds.security]");
  v.table("security", dds.security,
          "Authentication, access control and encryption: only participants with keys may read and "
          "command");
  v.table("jpeg", dds.jpeg, "JPEG encoding of the compressed topics");
}

/// Participants that may command over DDS, in words; empty: none. Reentrant.
std::string commanders(const DdsSettings& settings);

/// True: it receives the notices of the domain's appliances.
inline bool fills_fleet(const DdsSettings& settings) { return settings.enabled; }

/// Checks the keys of an enabled participant, if there are any. Error: as dds::check_security().
/// Reentrant.
inline Result<> check_keys(const DdsSettings& settings, Dates dates) {
  if (!settings.enabled || !settings.security) return {};
  return dds::check_security(*settings.security, settings.domain, dates);
}

/// Checks what an enabled participant needs to start: the prefix and the network profile.
/// Reentrant.
Result<> check_settings(const DdsSettings& settings);

/// `identity` is completed by name and prefix. `views` and `cameras` by place in `names`.
std::unique_ptr<Sink> make_sink(const DdsSettings& settings, const StatusNames& names,
                                const std::vector<PublishedView>& views,
                                const std::vector<PublishedCamera>& cameras,
                                const CommandPath& commands,
                                const std::shared_ptr<hal::SharedThreads>& background,
                                const ApplianceIdentity& identity,
                                const std::shared_ptr<Fleet>& fleet, const MachinePath& machine);

}  // namespace orbwatch::app
