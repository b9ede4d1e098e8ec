// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "app/cli/options/options.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::app::cli {

/// Default values of a view.
inline constexpr optics::ViewSpec kDefaultView{
    optics::ViewKind::Perspective, {}, {}, {}, 1280, 720};

/// Options that describe a view; they write into `view`, which outlives them.
std::vector<Option> view_options(optics::ViewSpec& view);

}  // namespace orbwatch::app::cli
