#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <vector>

#include "app/dds/entity.h"

namespace orbwatch::app {

/// The most samples that take_samples() takes at once; a reader's history need not be deeper.
inline constexpr std::int32_t kMaxTaken = 8;

/// Looks at a sample of the topic's type, which is valid during the call only.
using LookAtSample = std::function<void(const void* sample, const dds_sample_info_t& info)>;

/// Takes what a reader holds at this moment, kMaxTaken samples at most, without waiting. Returns
/// how many there were, with those that carry no data. Thread-safe. Error: DDS refuses.
Result<std::size_t> take_samples(dds_entity_t reader, const LookAtSample& look);

/// Wakes whoever waits when any of `readers` has data. The set ends with `participant`, each
/// reader's part in it with the reader.
Result<Entity> make_wait_set(const Entity& participant, const std::vector<dds_entity_t>& readers);

/// Whether there is data before the time is over. Thread-bound. Error: DDS refuses.
Result<bool> wait_for_data(const Entity& wait_set, std::chrono::nanoseconds timeout);

}  // namespace orbwatch::app
