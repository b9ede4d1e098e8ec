// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/server/access_list.h"

#include <utility>

namespace orbwatch::app::modbus {
namespace {

/// Returns whether the client is on the server's host: packets from other hosts have neither its
/// address nor a loopback address as their source.
bool is_same_host(const HostAddress& client, const HostAddress& server) {
  return client == server || hal::is_loopback(client);
}

}  // namespace

Result<AccessList> AccessList::create(const std::vector<std::string>& readers,
                                      const std::vector<std::string>& writers) {
  auto may_read = hal::parse_networks(readers);
  if (!may_read) return fail("modbus: readers: " + may_read.error().message);
  auto may_write = hal::parse_networks(writers);
  if (!may_write) return fail("modbus: writers: " + may_write.error().message);
  AccessList list;
  list.readers_ = std::move(*may_read);
  list.writers_ = std::move(*may_write);
  return list;
}

Permission AccessList::of(const HostAddress& client, const HostAddress& server) const {
  const bool is_reader = readers_.empty() || hal::any_contains(readers_, client);
  const bool is_writer = writers_.empty() ? is_reader && is_same_host(client, server)
                                          : hal::any_contains(writers_, client);
  if (is_writer) return Permission::Write;
  return is_reader ? Permission::Read : Permission::None;
}

}  // namespace orbwatch::app::modbus
