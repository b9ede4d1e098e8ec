// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/machine/machine_desk.h"

#include <array>
#include <optional>
#include <string>

#include "app/ports/web/api/changes.h"
#include "app/ports/web/api/record.h"
#include "app/ports/web/api/record_schema.h"

namespace orbwatch::app::web {
namespace {

/// Body of a state; what is left out is not known.
struct MachineStateBody {
  std::optional<std::uint32_t> sequence;
  std::optional<double> clock;
  std::string part;
  std::array<std::optional<double>, kMachineValues.size()> values;  ///< by place in the list
};

template <class Visitor>
void visit(Visitor& v, MachineStateBody& body) {
  v.optional("sequence", body.sequence, Range::between(0, 4294967295),
             "Number of the state; one that repeats the number before is ignored");
  v.optional("clock", body.clock, Range::between(0, kMostClock),
             "The controller's clock at the moment of the state, since any moment; without it the "
             "moment is the arrival less delay_ms",
             "s");
  v.optional("part", body.part, "Name of the part, at most 32 bytes of UTF-8");
  for (std::size_t i = 0; i < kMachineValues.size(); ++i) {
    const MachineValue& value = kMachineValues[i];
    v.optional(value.name, body.values[i], Range::between(value.minimum, value.maximum),
               value.description, value.unit);
  }
}

Result<MachineState> state_of(const MachineStateBody& body) {
  const auto part = PartName::make(body.part);
  if (!part) return tl::unexpected(part.error());
  MachineState state{
      .sequence = body.sequence, .clock = body.clock.value_or(signals::kNotValid), .part = *part};
  for (std::size_t i = 0; i < kMachineValues.size(); ++i) {
    state.values.*kMachineValues[i].get = body.values[i].value_or(signals::kNotValid);
  }
  return state;
}

}  // namespace

Response MachineDesk::take(const Request& request) const {
  if (path_.source != MachineSource::Http) {
    return error_response(409, wrong_source(path_, MachineSource::Http).message);
  }
  const auto taken = path_.take(parse_record<MachineStateBody>(request.body).and_then(state_of));
  if (!taken) return error_response(400, taken.error().message);
  Done done;
  return json_response(json_text(json_of(done)));
}

Route machine_state_route(const MachineDesk* desk) {
  Route route{"POST", "/api/v1/machine_state", Role::Operator,
              "Takes a state of the machine, with source = \"http\" under [machine]: each frame "
              "set has its values at the exposure, in component machine of the status. Not in the "
              "audit",
              std::string(kJson)};
  route.body = schema_of<MachineStateBody, Sent::ByClient>;
  route.answer = schema_of<Done, Sent::ByUs>;
  route.serve = [desk](const ExchangePtr& exchange) {
    exchange->answer(desk->take(exchange->request()));
  };
  return route;
}

}  // namespace orbwatch::app::web
