#pragma once

#include <vector>

#include "src/core/parallel.h"
#include "src/engines/contact/gap_contact.h"
#include "src/model/step_report.h"

namespace polargrain {

/// Adds the contacts that have pushed in the step, or in a part of it, to the report; those of walls first.
void report_contacts(const std::vector<GapContact>& contacts, const Parallel& parallel, StepReport& report);

/// Puts the reported contacts into the order of their bodies, those of one pair as they were found.
void sort_reported(StepReport& report);

}  // namespace polargrain
