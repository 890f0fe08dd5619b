// The vocoder of Flite's statistical voices, as this thread's turn wants it. Flite's own f0_shift moves the
// mean of F0 and leaves its range (slt, awb) or does nothing (rms). So programs that link this room are
// linked with
// --wrap=mlsa_resynthesis, and F0 (channel 0 of the track, Hz, 0 where unvoiced) is scaled as a whole.
#pragma once

namespace viaface {

struct Vocoder {
    float pitch = 1;
    bool mute = false;  // phones are timed without making their sound
};

Vocoder& vocoder();  // of this thread

}  // namespace viaface
