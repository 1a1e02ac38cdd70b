#include "src/model/contact.h"

namespace polargrain {

const char* to_string(SlipMode mode) {
    switch (mode) {
        case SlipMode::separating: return "separating";
        case SlipMode::sliding: return "sliding";
        case SlipMode::sticks_in_compression: return "sticks_in_compression";
        case SlipMode::reverses_in_compression: return "reverses_in_compression";
        case SlipMode::sticks_in_restitution: return "sticks_in_restitution";
        case SlipMode::reverses_in_restitution: return "reverses_in_restitution";
        case SlipMode::direct_sticking: return "direct_sticking";
        case SlipMode::direct_sliding: return "direct_sliding";
        case SlipMode::on_feet: return "on_feet";
        case SlipMode::on_face: return "on_face";
        case SlipMode::foot: return "foot";
    }
    return "unknown";
}

}  // namespace polargrain
