// The report's face model made again on scanned postures, and how far it falls from what it is asked for,
// beside the report's own figures. [ATR98, eqs. 1-15]
#pragma once

#include <string>
#include <vector>

#include "facemodel/estimator.hpp"
#include "facemodel/pca.hpp"
#include "synth/training/scan.hpp"

namespace viaface {

struct Distances {  // mm
    double mean = 0, rms = 0, p95 = 0, max = 0;
};
Distances distances(std::vector<double> values);

// Scan to fitted mesh, one posture.
struct FitFigures {
    std::string posture;
    Distances surface;                                // scan samples to mesh
    Eigen::Vector3d worst = Eigen::Vector3d::Zero();  // where on the scan, mm, head frame
    Distances markers;                                // asked to fitted, 18 markers
};

// A posture against a model that was not trained on it: over the 576 nodes.
struct UnseenFigures {
    std::string posture;
    Distances span;    // to the nearest shape that the components can draw
    Distances drawn;   // to the shape estimated from its 18 markers (eq. 15)
    Distances lips;    // drawn, over the 40 nodes of the outer lip contour
    Distances points;  // 18 markers and 16 lip points to the span of the postures' own
};

// A model of one set of postures.
struct ModelFigures {
    int postures = 0, components = 0;
    double noise_mm = 0;                  // of the estimator: 0 for the pseudo-inverse
    Eigen::VectorXd share;                // [components], of the variance
    double condition = 0;                 // of the markers' deviations: largest by smallest singular value
    double trained_max = 0;               // mm: worst node of a training posture drawn from its own markers
    std::vector<UnseenFigures> left_out;  // each posture drawn by the model of the others
    std::vector<UnseenFigures> unseen;    // postures that are in neither set
};

struct AtrReport {
    int nodes = 0, polygons = 0, quads = 0, scan_samples = 0;
    std::vector<FitFigures> fit;     // the eight postures
    ModelFigures eight, talker;      // eight: eq. 12 by pseudo-inverse; talker: with a ridge
    double talker_unridged_max = 0;  // mm: worst node of a posture left out, talker's by pseudo-inverse
    std::vector<UnseenFigures> beyond_eight;  // the eight's model on pressed /m/ and tucked /f/
};

AtrReport measure_atr(const BlendHead& head);
std::string as_text(const AtrReport& report);
std::string atr_report(const BlendHead& head);

}  // namespace viaface
