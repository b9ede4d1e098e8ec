// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "app/model/configuration/configuration_files.h"
#include "app/ports/web/access/audit/audit.h"
#include "app/ports/web/api/changes.h"
#include "app/ports/web/api/record.h"
#include "app/ports/web/api/route.h"
#include "app/ports/web/configuration/configuration_records.h"
#include "app/ports/web/configuration/recipe_records.h"

namespace orbwatch::app::web {

/// Handlers that read, check, try out and confirm the files of the configuration, and single limits
/// and regions of a recipe within its file or in a copy of it. The configuration file itself
/// determines where users are kept and which camera modules run: another text of it needs an
/// administrator. Thread-safe; all wait
/// for the disk, except show().
class ConfigurationDesk {
 public:
  /// `files` null: all requests are refused. `audit` and `changes` outlive the desk.
  ConfigurationDesk(std::shared_ptr<ConfigurationFiles> files, const Audit& audit,
                    Changes& changes);

  void show(const ExchangePtr& exchange);

  Answered<ConfigurationFiles::Change> check(Change<ConfigurationBody>& change);
  Answered<TrialAnswer> try_out(Change<ConfigurationBody>& change);
  Answered<ConfigurationFiles::Change> check_recipe(Change<RecipeBody>& change);
  Answered<TrialAnswer> try_recipe(Change<RecipeBody>& change);
  Answered<ConfirmedAnswer> confirm(Change<Nothing>& change);
  Answered<Done> revert(Change<Nothing>& change);

 private:
  using Edit = ConfigurationFiles::Edit;

  Answered<ConfigurationAnswer> read() const;
  Answered<Edit> edit_of(const RecipeBody& body) const;
  Answered<ConfigurationFiles::Change> check_edit(ChangeRequest& change,
                                                  const Answered<Edit>& edit) const;
  Answered<TrialAnswer> try_edit(ChangeRequest& change, const Answered<Edit>& edit, int seconds);
  Answered<Edit> permitted(const ChangeRequest& change, const Edit& edit) const;
  Answered<Edit> based(const Edit& edit) const;
  Result<> check_basis(const ConfigurationFiles::State& state, const Edit& edit) const;
  std::string changer_of(const std::string& name, const ConfigurationFiles::Version& now) const;

  const std::shared_ptr<ConfigurationFiles> files_;
  const Audit& audit_;
  Changes& changes_;
};

}  // namespace orbwatch::app::web
