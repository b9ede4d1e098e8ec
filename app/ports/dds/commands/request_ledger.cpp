#include "app/ports/dds/commands/request_ledger.h"

#include <algorithm>
#include <utility>

namespace orbwatch::app {

std::vector<RequestLedger::Entry>::const_iterator RequestLedger::find(std::uint64_t client) const {
  return std::ranges::find(entries_, client,
                           [](const Entry& entry) { return entry.newest.client; });
}

RequestLedger::Verdict RequestLedger::judge(const RequestId& id) const {
  const auto entry = find(id.client);
  if (entry == entries_.end() || id.number > entry->newest.number) return Verdict::New;
  return id.number == entry->newest.number ? Verdict::Again : Verdict::Late;
}

const CommandAnswer& RequestLedger::answer(const RequestId& id) const {
  return find(id.client)->answer;
}

void RequestLedger::record(const RequestId& id, CommandAnswer answer) {
  if (const auto entry = find(id.client); entry != entries_.end()) {
    entries_.erase(entry);
  } else if (entries_.size() == capacity_) {
    entries_.erase(entries_.begin());
  }
  entries_.push_back({id, std::move(answer)});
}

}  // namespace orbwatch::app
