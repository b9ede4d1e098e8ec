// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "app/ports/dds/commands/command_request.h"

namespace orbwatch::app::dds {

/// The newest answer to each client, so that no request is executed twice: networks repeat samples,
/// and clients repeat requests whose answers they missed. The size is bounded. Thread-bound.
class RequestLedger {
 public:
  /// `clients`: limit; the client that has been silent longest is evicted first.
  explicit RequestLedger(std::size_t clients) : capacity_(clients) {}

  enum class Verdict {
    New,    ///< newer than all previous requests of its client
    Again,  ///< its client's newest, already answered
    Late    ///< older than its client's newest
  };
  Verdict judge(const RequestId& id) const {
    const auto entry = find(id.client);
    if (entry == entries_.end() || id.number > entry->newest.number) return Verdict::New;
    return id.number == entry->newest.number ? Verdict::Again : Verdict::Late;
  }

  /// The answer to a request whose verdict is Again.
  const CommandAnswer& answer(const RequestId& id) const { return find(id.client)->answer; }

  /// Keeps the answer to a request whose verdict is New.
  void record(const RequestId& id, CommandAnswer answer) {
    if (const auto entry = find(id.client); entry != entries_.end()) {
      entries_.erase(entry);
    } else if (entries_.size() == capacity_) {
      entries_.erase(entries_.begin());
    }
    entries_.push_back({id, std::move(answer)});
  }

 private:
  struct Entry {
    RequestId newest;
    CommandAnswer answer;
  };
  std::vector<Entry>::const_iterator find(std::uint64_t client) const {
    return std::ranges::find(entries_, client,
                             [](const Entry& entry) { return entry.newest.client; });
  }

  std::size_t capacity_;
  std::vector<Entry> entries_;  ///< ordered by the time of the last new request, oldest first
};

}  // namespace orbwatch::app::dds
