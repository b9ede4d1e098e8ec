// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/topics/topic_reader.h"

#include <algorithm>
#include <array>

#include "app/ports/dds/ros/type_hash.h"

namespace orbwatch::app::dds {

Result<> TopicReader::open(const Entity& participant, const Qos& qos,
                           const dds_listener_t* listener) {
  auto reader = announce_type_hash(qos, *type_)
                    .and_then([&] { return make_topic(participant, *type_, name_); })
                    .and_then([&](Entity topic) {
                      topic_ = std::move(topic);
                      return make_reader(participant, topic_, qos, listener);
                    });
  if (!reader) return fail(reader.error().message + " (" + name_ + ")");
  reader_ = std::move(*reader);
  return {};
}

void TopicReader::close() {
  reader_.reset();
  topic_.reset();
}

Result<std::size_t> take_samples(dds_entity_t reader, const AcceptSample& accept) {
  std::array<void*, kMaxTaken> samples{};  // null: DDS loans samples
  std::array<dds_sample_info_t, kMaxTaken> infos{};
  const dds_return_t count =
      dds_take(reader, samples.data(), infos.data(), samples.size(), kMaxTaken);
  if (count < 0) return tl::unexpected(dds_error("take", count));
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    if (infos[i].valid_data) accept(samples[i], infos[i]);
  }
  if (count > 0) {
    const dds_return_t returned = dds_return_loan(reader, samples.data(), count);
    if (returned < 0) return tl::unexpected(dds_error("return of samples", returned));
  }
  return static_cast<std::size_t>(count);
}

void take_all_samples(dds_entity_t reader, const AcceptSample& accept) {
  for (auto taken = take_samples(reader, accept); taken && *taken > 0;) {
    taken = take_samples(reader, accept);
  }
}

Result<Entity> make_wait_set(const Entity& participant, const std::vector<dds_entity_t>& readers) {
  Entity wait_set(dds_create_waitset(participant.get()));
  if (wait_set.get() < 0) return tl::unexpected(dds_error("wait set", wait_set.get()));
  for (const dds_entity_t reader : readers) {
    const dds_entity_t condition = dds_create_readcondition(reader, DDS_ANY_STATE);
    const dds_return_t code = dds_waitset_attach(wait_set.get(), condition, 0);
    if (code < 0) return tl::unexpected(dds_error("wait set", code));
  }
  return wait_set;
}

Result<bool> wait_for_data(const Entity& wait_set, std::chrono::nanoseconds timeout) {
  const dds_return_t code =
      dds_waitset_wait(wait_set.get(), nullptr, 0, std::max<dds_duration_t>(timeout.count(), 0));
  if (code < 0) return tl::unexpected(dds_error("wait", code));
  return code > 0;
}

}  // namespace orbwatch::app::dds
