#pragma once

#include <vector>

#include "src/engines/contact/gap_contact.h"
#include "src/model/checkpoint.h"

namespace polargrain {

/// Puts contacts and the pairs that they belong to into a checkpoint, as far as the next step needs them.
void save_contacts(const std::vector<GapContact>& contacts, const std::vector<PairContacts>& pairs,
                   Checkpoint& checkpoint);

/// The same back, to the bit, but for the gaps at which pairs rest, which follow from the scene.
void load_contacts(const Checkpoint& checkpoint, std::vector<GapContact>& contacts, std::vector<PairContacts>& pairs);

}  // namespace polargrain
