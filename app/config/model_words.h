#pragma once

#include <array>

#include "app/config/constraint.h"
#include "proc/optics/ball_model.h"

namespace orbwatch::app {

/// How files and options call the ball's models.
inline constexpr std::array kModels{Word{"exact", optics::BallModel::Kind::Exact},
                                    Word{"paper", optics::BallModel::Kind::Paper},
                                    Word{"classical", optics::BallModel::Kind::Classical}};

}  // namespace orbwatch::app
