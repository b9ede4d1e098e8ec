#include "app/modbus/bits.h"
#include "app/modbus/rows/block.h"
#include "app/modbus/rows/rows.h"

namespace orbwatch::app::modbus {
namespace {

/// A word's bits from discrete input `address` on; up to `end` the rest is reserved.
void append(Block<Snapshot>& block, const std::vector<Bit>& bits, int address, int end) {
  for (const Bit& bit : bits) {
    if (bit.is_set) block.reserved_to(address).bit(bit.name, bit.description, bit.is_set);
    ++address;
  }
  block.reserved_to(end);
}

}  // namespace

std::vector<Row> discrete_rows() {
  Block<Snapshot> block(Table::Discrete, 0, "", whole_snapshot);
  append(block, status_bits(), kStatusBits, kMeasurementBits);
  append(block, measurement_bits(), kMeasurementBits, kProcessInputBits);
  append(block, process_input_bits(), kProcessInputBits, kActiveBits);
  append(block, active_bits(), kActiveBits, kUnacknowledgedBits);
  append(block, unacknowledged_bits(), kUnacknowledgedBits, kDiscreteInputs);
  return block.rows();
}

}  // namespace orbwatch::app::modbus
