// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/ports/dds/participant/entity.h"
#include "proc/image/result.h"

namespace orbwatch::app::dds {

/// Announces the hash of an endpoint's type, which ROS 2 compares since Iron (REP 2011):
/// "typehash=RIHS01_...;" in the USER_DATA of the writer or reader made with `qos`. Humble ignores
/// it. Error: a type that is not in app/ports/dds/idl. Reentrant.
Result<> announce_type_hash(const Qos& qos, const dds_topic_descriptor_t& type);

}  // namespace orbwatch::app::dds
