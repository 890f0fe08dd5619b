#include "synth/speech/flite_vocoder.hpp"

#include <flite/flite.h>

extern "C" {
#include <flite/cst_cg.h>

cst_wave* __real_mlsa_resynthesis(const cst_track*, const cst_track*, cst_cg_db*, cst_audio_streaming_info*,
                                  int);
}

extern "C" cst_wave* __wrap_mlsa_resynthesis(const cst_track* track, const cst_track* strengths,
                                             cst_cg_db* voice, cst_audio_streaming_info* streaming,
                                             int speed) {
    const auto [pitch, mute] = viaface::vocoder();
    if (mute) return nullptr;  // Flite goes on with an empty wave
    for (int i = 0; i < track->num_frames; ++i) track->frames[i][0] *= pitch;
    return __real_mlsa_resynthesis(track, strengths, voice, streaming, speed);
}

viaface::Vocoder& viaface::vocoder() {
    thread_local Vocoder own;
    return own;
}
