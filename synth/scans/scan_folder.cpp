#include "synth/scans/scan_folder.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "facemodel/gltf_scan.hpp"
#include "facemodel/ply.hpp"
#include "facemodel/range_scan.hpp"
#include "facemodel/vtk_polydata.hpp"
#include "synth/film/media_reader.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;
using Eigen::Matrix3d, Eigen::Vector3d;
using nlohmann::json;

constexpr std::size_t kLargestFile = 2u << 30;
constexpr Eigen::Index kManyNodes = 400'000;
constexpr const char* kFormats = "OBJ, PLY, VTK, GLB, glTF or PGM";

[[noreturn]] void refuse(const std::string& field, const std::string& value, const std::string& allowed) {
    throw InputError(field, value, allowed);
}

std::string ending(const fs::path& file) {
    std::string text = file.extension().string();
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

bool is_picture(const fs::path& file) {
    const auto e = ending(file);
    return e == ".png" || e == ".jpg" || e == ".jpeg" || e == ".bmp" || e == ".tga" || e == ".tif" ||
           e == ".tiff";
}

bool is_scan(const fs::path& file) {
    const auto e = ending(file);
    return e == ".obj" || e == ".ply" || e == ".vtk" || e == ".glb" || e == ".gltf" || e == ".pgm";
}

Texture picture_of(const MediaSource& source) {
    FrameReader reader(source);
    const auto first = reader.next();
    if (!first) refuse("scans", "a picture without pixels", "a picture");
    const Frame& frame = first->frame;
    Texture texture{frame.width, frame.height, 3, {}};
    texture.pixels.reserve(static_cast<std::size_t>(frame.width) * frame.height * 3);
    for (std::size_t i = 0; i < static_cast<std::size_t>(frame.width) * frame.height; ++i)
        texture.pixels.insert(texture.pixels.end(), &frame.rgba[4 * i], &frame.rgba[4 * i] + 3);
    return texture;
}

// Nothing outside the folder.
fs::path beside(const fs::path& folder, const std::string& name) {
    const fs::path file = fs::path(name).lexically_normal();
    if (file.is_absolute() || file.empty() || *file.begin() == "..")
        refuse("scans", name, "a file within the folder");
    return folder / file;
}

RangeLayout layout_of(const json& settings) {
    if (!settings.contains("cylinder"))
        refuse("scans.json", "no \"cylinder\"", "step, bottom, top of a .pgm map");
    const json& c = settings["cylinder"];
    RangeLayout layout;
    layout.step = c.at("step");
    layout.bottom = c.at("bottom");
    layout.top = c.at("top");
    layout.angle_from_deg = c.value("angle_from_deg", layout.angle_from_deg);
    layout.angle_to_deg = c.value("angle_to_deg", layout.angle_to_deg);
    layout.largest_jump = c.value("largest_jump", layout.largest_jump);
    return layout;
}

void name_obj_pictures(ScanMesh& mesh, const ObjScan& scan, const fs::path& folder) {
    for (const std::string& library : scan.libraries) {
        const fs::path file = beside(folder, library);
        if (!fs::exists(file)) continue;
        const auto pictures = parse_mtl(read_text(file, "scans"));
        for (const std::string& material : scan.materials) {
            const auto found = pictures.find(material);
            if (found != pictures.end()) mesh.pictures.push_back(found->second);
        }
    }
}

ScanMesh read_mesh(const fs::path& folder, const fs::path& file, const json& settings) {
    try {
        const Bytes bytes = read_bytes(file, "scan", kLargestFile);
        const std::string kind = ending(file);
        if (kind == ".ply") return parse_ply(bytes);
        if (kind == ".vtk") return parse_vtk(bytes);
        if (kind == ".pgm") return range_surface(parse_pgm(bytes), layout_of(settings));
        if (kind == ".glb" || kind == ".gltf") {
            return parse_gltf_scan(bytes, [&](const std::string& name) {
                return read_bytes(beside(folder, name), "scan", kLargestFile);
            });
        }
        const ObjScan scan = parse_obj({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        ScanMesh mesh = scan_mesh(scan);
        name_obj_pictures(mesh, scan, folder);
        return mesh;
    } catch (const InputError& error) {
        refuse(error.field(), file.filename().string() + ": " + error.value(), error.allowed());
    }
}

Texture named_picture(const ScanMesh& mesh, const fs::path& folder) {
    if (!mesh.picture.empty()) return picture_of(std::span<const std::uint8_t>(mesh.picture));
    for (const std::string& name : mesh.pictures) {
        const fs::path file = beside(folder, name);
        if (fs::exists(file)) return picture_of(file);
    }
    return {};
}

// The picture of the folder that shows most skin at the mesh's texture places.
Texture likely_picture(const ScanMesh& mesh, const fs::path& folder, const fs::path& mesh_file,
                       std::vector<std::string>& remarks) {
    constexpr double kNormalMap = 0.9, kLeastSkin = 0.3;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (is_picture(entry.path())) files.push_back(entry.path());
    }
    std::ranges::sort(files);
    Texture best;
    double most = 0;
    std::string chosen;
    for (const fs::path& file : files) {
        Texture picture = picture_of(file);
        const std::string name = file.filename().string();
        if (normal_map_share(picture) > kNormalMap) {
            remarks.push_back(name + " is a normal map and was left");
            continue;
        }
        double worth = skin_share(mesh, picture);
        if (worth < kLeastSkin) {
            remarks.push_back(name + " shows little skin at the mesh's texture places and was left");
            continue;
        }
        if (file.stem() == mesh_file.stem()) worth += 0.2;
        if (worth <= most) continue;
        most = worth;
        best = std::move(picture);
        chosen = name;
    }
    if (!chosen.empty()) remarks.push_back("colour map: " + chosen);
    return best;
}

double unit_of(const json& value) {
    if (value.is_number() && value.get<double>() > 0) return value;
    const std::map<std::string, double> units = {{"m", 1000}, {"cm", 10}, {"mm", 1}, {"inch", 25.4}};
    if (value.is_string() && units.contains(value.get<std::string>()))
        return units.at(value.get<std::string>());
    refuse("scans.json", "units: " + value.dump(), "m, cm, mm, inch or a number of millimetres above 0");
}

Vector3d axis_of(const json& value) {
    const std::string text = value.get<std::string>();
    if (text.size() == 2 && (text[0] == '+' || text[0] == '-') && text[1] >= 'x' && text[1] <= 'z')
        return (text[0] == '+' ? 1.0 : -1.0) * Vector3d::Unit(text[1] - 'x');
    refuse("scans.json", "axes: " + text, "+x, -x, +y, -y, +z or -z");
}

void read_settings(const json& settings, ScanFolder& scans) {
    if (settings.contains("units")) scans.mm_per_unit = unit_of(settings["units"]);
    if (settings.contains("axes")) {
        const Vector3d up = axis_of(settings["axes"].at("up")),
                       forward = axis_of(settings["axes"].at("forward"));
        if (up.dot(forward) != 0)
            refuse("scans.json", "axes: up and forward in one line", "two different axes");
        Matrix3d turn;
        turn << up.cross(forward).transpose(), up.transpose(), forward.transpose();
        scans.view_from_scan = turn;
    }
    scans.mirrored = settings.value("mirrored", false);
    for (const auto& [name, place] : settings.value("landmarks", json::object()).items()) {
        const auto numbers = place.get<std::array<double, 3>>();
        scans.landmarks[name] = Vector3d(numbers[0], numbers[1], numbers[2]);
    }
}

std::map<std::string, std::string> posture_files(const fs::path& folder, const json& settings,
                                                 std::vector<std::string>& remarks) {
    if (settings.contains("postures")) return settings["postures"].get<std::map<std::string, std::string>>();
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (is_scan(entry.path())) files.push_back(entry.path());
    }
    if (files.empty()) refuse("scans", folder.string(), std::string("a folder with a scan: ") + kFormats);
    std::ranges::sort(files);
    std::string finest;
    std::size_t most = 0;
    for (const fs::path& file : files) {
        const std::size_t triangles =
            files.size() == 1 ? 1 : read_mesh(folder, file, settings).triangles.size();
        const bool called_neutral = file.stem().string().find("neutral") != std::string::npos;
        if (triangles < most || (triangles == most && !called_neutral)) continue;
        most = triangles;
        finest = file.filename().string();
    }
    remarks.push_back("neutral posture: " + finest + (files.size() > 1 ? ", the finest mesh" : ""));
    return {{"neutral", finest}};
}

}  // namespace

double normal_map_share(const Texture& picture) {
    std::size_t unit = 0, out = 0, count = 0;
    for (std::size_t i = 0; i + 2 < picture.pixels.size(); i += 3 * 17, ++count) {
        const Vector3d n = Vector3d(picture.pixels[i], picture.pixels[i + 1], picture.pixels[i + 2]) / 127.5 -
                           Vector3d::Ones();
        if (std::abs(n.norm() - 1) < 0.15) ++unit;
        if (n.z() > 0.5) ++out;
    }
    return count == 0 ? 0 : static_cast<double>(std::min(unit, out)) / static_cast<double>(count);
}

double skin_share(const ScanMesh& mesh, const Texture& picture) {
    if (mesh.uv_triangles.empty()) return 0;
    std::size_t skin = 0, count = 0;
    const std::size_t step = std::max<std::size_t>(1, mesh.uv_triangles.size() / 4000);
    for (std::size_t t = 0; t < mesh.uv_triangles.size(); t += step, ++count) {
        Eigen::Vector2d uv = Eigen::Vector2d::Zero();
        for (const int place : mesh.uv_triangles[t]) uv += mesh.uvs.row(place).transpose() / 3;
        const Eigen::Vector3f c = bilinear(picture, uv.x(), uv.y());
        if (c[0] > 30 && c[0] > c[1] && c[1] > 0.8f * c[2] && c[0] - c[2] > 0.08f * c[0]) ++skin;
    }
    return static_cast<double>(skin) / static_cast<double>(count);
}

ScanMesh mended(ScanMesh mesh, std::vector<std::string>& remarks) {
    constexpr double kScrap = 0.02;
    const double size = (mesh.nodes.colwise().maxCoeff() - mesh.nodes.colwise().minCoeff()).maxCoeff();
    if (!(size > 0)) refuse("scan", "a surface without extent", "a head");
    if (mesh.nodes.rows() > kManyNodes) {
        const auto before = mesh.nodes.rows();
        mesh = thinned(mesh, size / std::sqrt(static_cast<double>(kManyNodes) / 2));
        remarks.push_back("thinned from " + std::to_string(before) + " to " +
                          std::to_string(mesh.nodes.rows()) + " nodes");
    }
    const auto pieces = pieces_of(mesh);
    std::vector<char> keep(mesh.triangles.size());
    std::size_t scraps = 0;
    for (const auto& piece : pieces) {
        const bool kept = static_cast<double>(piece.size()) >= kScrap * static_cast<double>(pieces[0].size());
        scraps += kept ? 0 : piece.size();
        for (const int t : piece) keep[static_cast<std::size_t>(t)] = kept;
    }
    if (scraps > 0) {
        remarks.push_back(std::to_string(scraps) + " triangles of loose scraps were left out");
        ScanMesh whole = mesh;
        whole.triangles.clear();
        whole.uv_triangles.clear();
        for (std::size_t t = 0; t < keep.size(); ++t) {
            if (!keep[t]) continue;
            whole.triangles.push_back(mesh.triangles[t]);
            if (!mesh.uv_triangles.empty()) whole.uv_triangles.push_back(mesh.uv_triangles[t]);
        }
        mesh = std::move(whole);
    }
    return mesh;
}

ScanFolder read_scan_folder(const fs::path& folder) {
    if (!fs::is_directory(folder)) refuse("scans", folder.string(), "a folder of scans");
    ScanFolder scans;
    json settings = json::object();
    try {
        if (fs::exists(folder / "scans.json"))
            settings = json::parse(read_text(folder / "scans.json", "scans"));
        read_settings(settings, scans);
        scans.files = posture_files(folder, settings, scans.remarks);
        if (!scans.files.contains("neutral")) refuse("scans.json", "no posture \"neutral\"", "one");
        for (const auto& [posture, name] : scans.files) {
            const fs::path file = beside(folder, name);
            std::vector<std::string> mends;
            PaintedSurface surface{mended(read_mesh(folder, file, settings), mends), {}};
            for (const std::string& mend : mends) {
                if (std::ranges::find(scans.remarks, mend) == scans.remarks.end())
                    scans.remarks.push_back(mend);
            }
            if (posture == "neutral") {
                surface.picture = settings.contains("colour") ? picture_of(beside(folder, settings["colour"]))
                                                              : named_picture(surface.mesh, folder);
                if (surface.picture.pixels.empty() && !surface.mesh.uv_triangles.empty())
                    surface.picture = likely_picture(surface.mesh, folder, file, scans.remarks);
            }
            scans.postures.emplace(posture, std::move(surface));
        }
    } catch (const json::exception& error) {
        refuse("scans.json", error.what(), "the fields that viaface talker make --help tells");
    }
    if (!scans.postures.at("neutral").painted())
        scans.remarks.push_back("the scan has no colours: the generic skin is painted");
    return scans;
}

}  // namespace viaface
