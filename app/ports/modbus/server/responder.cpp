// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/server/responder.h"

#include <modbus.h>

#include <array>
#include <utility>

#include "app/ports/modbus/server/device_identification.h"

namespace orbwatch::app::modbus {

Result<std::unique_ptr<Responder>> Responder::create(const RegisterMap& map, WriteRegisters write,
                                                     MakeImage make_image) {
  Mapping mapping(modbus_mapping_new(map.size(Table::Coil), map.size(Table::Discrete),
                                     map.size(Table::Holding), map.size(Table::Input)),
                  modbus_mapping_free);
  if (!mapping) return fail("modbus: no memory for the registers");
  return std::unique_ptr<Responder>(
      new Responder(map, std::move(write), std::move(make_image), std::move(mapping)));
}

Responder::Responder(const RegisterMap& map, WriteRegisters write, MakeImage make_image,
                     Mapping mapping)
    : map_(map),
      write_(std::move(write)),
      make_image_(std::move(make_image)),
      mapping_(std::move(mapping)) {}

Outcome Responder::answer(Transport& transport, std::span<const std::uint8_t> frame,
                          bool may_write) {
  const auto pdu = transport.pdu_of(frame);
  if (pdu[0] >= 0x80) return Outcome::NotModbus;  // an answer, not a request
  const auto refuse = [&](Exception exception, Outcome outcome = Outcome::Refused) {
    return transport.refuse(frame, exception) ? outcome : Outcome::NotSent;
  };
  const auto answered = [](bool sent) { return sent ? Outcome::Answered : Outcome::NotSent; };
  if (!transport.is_ours(frame)) return refuse(Exception::GatewayTargetFailed);
  if (pdu[0] == kEncapsulatedInterface) {
    const auto identification = identify(pdu);
    return identification ? answered(transport.send(frame, *identification))
                          : refuse(identification.error());
  }
  const auto request = parse(pdu);
  if (!request) return refuse(request.error());
  if ((request->write || request->mask) && !may_write) {
    return refuse(Exception::IllegalFunction, Outcome::Forbidden);
  }
  const std::lock_guard lock(mutex_);
  if (const auto exception = execute(*request)) return refuse(*exception);
  // Answered here, because libmodbus would store the written values in its registers and read from
  // there.
  if (request->read && request->write) {
    return answered(transport.send(frame, read_write_answer(*request->read)));
  }
  return answered(transport.reply(frame, *mapping_));
}

/// The answer to Read/Write Multiple Registers.
std::vector<std::uint8_t> Responder::read_write_answer(const Range& read) const {
  std::vector<std::uint8_t> pdu{MODBUS_FC_WRITE_AND_READ_REGISTERS,
                                static_cast<std::uint8_t>(2 * read.count)};
  for (int at = read.address; at < read.address + read.count; ++at) {
    const std::uint16_t word = mapping_->tab_registers[at];
    pdu.push_back(static_cast<std::uint8_t>(word >> 8));
    pdu.push_back(static_cast<std::uint8_t>(word));
  }
  return pdu;
}

/// Writes, then fills the registers that the request reads.
std::optional<Exception> Responder::execute(Request request) {
  if (request.mask) request.write = resolved(*request.mask, map_, make_image_());
  if (const auto exception = check_access(request)) return exception;
  if (request.write) {
    if (const auto exception = write_(*request.write)) return exception;
  }
  if (request.read) fill_mapping(*request.read, make_image_());
  return std::nullopt;
}

std::optional<Exception> Responder::check_access(const Request& request) const {
  if (request.read) {
    if (const auto exception = check(*request.read, map_)) return exception;
  }
  return request.write ? check(*request.write, map_) : std::nullopt;
}

void Responder::fill_mapping(const Range& range, const ProcessImage& image) {
  const std::array<std::uint8_t*, 2> bits{mapping_->tab_bits, mapping_->tab_input_bits};
  const std::array<std::uint16_t*, 2> words{mapping_->tab_registers, mapping_->tab_input_registers};
  const std::size_t input = range.table == Table::Discrete || range.table == Table::Input ? 1 : 0;
  for (int place = range.address; place < range.address + range.count;) {
    const Row& row = *map_.find(range.table, place);
    place = row.address + row.count;
    if (!row.read) continue;  // reserved: stays 0
    const std::uint32_t value = row.read(image);
    if (row.type == Type::Bool) {
      bits[input][row.address] = static_cast<std::uint8_t>(value);
      continue;
    }
    if (row.count == 2) words[input][row.address] = static_cast<std::uint16_t>(value >> 16);
    words[input][place - 1] = static_cast<std::uint16_t>(value);
  }
}

}  // namespace orbwatch::app::modbus
