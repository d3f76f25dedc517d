// Collects the positions of a failing case for the picture in the report.
#pragma once

#include <evalcts/gl/observation.h>
#include <evalcts/judge/prediction.h>
#include <evalcts/results/test_record.h>

namespace evalcts {

// Returns the first vertices of the prediction, correctly rounded, and of the observation, divided by w.
Plot plot_of(const Prediction& prediction, const Observation& observation);

// Returns the plot of a case that a rule judges, without expected vertices.
Plot plot_of(const Observation& observation);

}  // namespace evalcts
