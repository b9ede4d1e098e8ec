// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "app/model/configuration/program.h"
#include "app/model/sink/interface_table.h"
#include "app/ports/web/api/record.h"
#include "app/ports/web/api/route.h"

namespace orbwatch::app::web {

struct AboutAnswer {
  std::vector<std::pair<std::string, std::string>> versions;
  std::string commanders;
};
template <class Visitor>
void visit(Visitor& v, AboutAnswer& about) {
  v.required("versions", about.versions, "Versions by name: orbwatchd first, then libraries");
  v.required("commanders", about.commanders, "Interfaces that accept commands, in words");
}

/// Rows by the name of their table, by interface: {"modbus": {"registers": [{"name": ...}, ...]}}.
/// A row has a text, a number, null or a flag for each column. In the order of the interfaces.
using InterfaceTables = std::vector<std::pair<std::string, std::vector<Json>>>;
using TablesAnswer = std::vector<std::pair<std::string, InterfaceTables>>;

/// Serves the versions of the program, and the tables of the other interfaces. Thread-safe.
class InterfaceRoutes {
 public:
  /// `tables` is called on any thread; empty: no tables.
  InterfaceRoutes(std::function<std::vector<InterfaceTable>()> tables, const Program& program)
      : tables_(std::move(tables)), about_{program.versions, program.commanders} {}

  Answered<AboutAnswer> about() const { return about_; }
  Answered<TablesAnswer> tables() const;

 private:
  const std::function<std::vector<InterfaceTable>()> tables_;
  const AboutAnswer about_;
};

}  // namespace orbwatch::app::web
