// SPDX-License-Identifier: Apache-2.0
#include "app/cli/dds/heard_appliances.h"

#include <algorithm>
#include <thread>

#include "app/ports/dds/fleet/fleet_reader.h"
#include "app/ports/dds/participant/dds_log.h"
#include "app/ports/dds/participant/participant.h"

namespace orbwatch::app::cli {
namespace {

constexpr std::chrono::milliseconds kListenPeriod{100};

}  // namespace

Result<> hear_appliances(int domain, const std::optional<dds::SecuritySettings>& security,
                         std::chrono::nanoseconds duration, const std::atomic<bool>& cancelled,
                         Fleet& fleet) {
  dds::limit_dds_log();
  const auto end = hal::Clock::now() + duration;
  const auto participant = dds::Participant::join(domain, security);
  if (!participant) return tl::unexpected(participant.error());
  dds::FleetReader reader(fleet);
  if (const auto opened = reader.open(participant->entity()); !opened) return opened;
  for (auto now = hal::Clock::now(); now < end && !cancelled; now = hal::Clock::now()) {
    std::this_thread::sleep_for(std::min<hal::Clock::duration>(kListenPeriod, end - now));
  }
  return {};
}

}  // namespace orbwatch::app::cli
