// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/ports/web/history/figure_history.h"

namespace orbwatch::app::web {

/// The history of all figures that were measured, as comma-separated values (RFC 4180): a line for
/// each step with its end, UTC, then two columns for each figure, "region pool: hot_spot_width low
/// (mm)" and the same with high. Reentrant.
std::string figure_table(const FigureHistory& history);

}  // namespace orbwatch::app::web
