// Figures, proofs and pairs of links as JSON objects, of a class such as nlohmann's.
#pragma once

#include <foam/geometry/measure.hpp>
#include <foam/judge/collision_model.hpp>
#include <foam/judge/evaluate.hpp>
#include <foam/sdk/kinds.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] judge {

/// Returns a number, or null if it is not finite.
template <class Json> Json json_number(double value) {
    return std::isfinite(value) ? Json(value) : Json();
}

/// Returns the figures under the names of manifest.json.
template <class Json> Json json_of_figures(const Figures& figures) {
    const Measures& m = figures.measures;
    Json json = json_of_measures<Json>(m);
    json["covered_standard_error"] = figures.covered_error;
    json["volume_ratio"] = json_number<Json>(1 + m.excess - m.missing);
    return json;
}

/// Returns file, format, notes and figures of one model.
template <class Json>
Json json_of_evaluation(const Original& original, const MatchedModel& model, const Evaluation& evaluation) {
    Json json{{"model", model.file.file.string()},
              {"model_format", model.file.format},
              {"notes", model.notes},
              {"proof", json_of_proof<Json>(proved_links(original, model, evaluation))},
              {"total", json_of_figures<Json>(evaluation.total)},
              {"with_spheres", json_of_figures<Json>(evaluation.with_spheres)},
              {"links", Json::array()}};
    for (std::size_t i = 0; i < original.links.size(); ++i) {
        Json link{{"link", original.links[i].link}};
        link.update(json_of_figures<Json>(evaluation.links[i]));
        if (const Elements& elements = model.elements[i]; !elements.are_spheres()) {
            link["kinds"] = json_of_kinds<Json>(kinds_of(elements));
        }
        json["links"].push_back(std::move(link));
    }
    return json;
}

/// Returns the proof of each link.
template <class Json> Json json_of_proofs(const Original& original, const std::vector<LinkProof>& proofs, bool outer) {
    Json links = Json::array();
    for (std::size_t i = 0; i < proofs.size(); ++i) {
        Json link{{"link", original.links[i].link}, {"certified", proofs[i].holds}};
        if (outer) {
            link["triangles"] = proofs[i].triangles;
            link["pieces"] = proofs[i].pieces;
            link["halvings"] = proofs[i].halvings;
        }
        if (!proofs[i].holds) {
            link[outer ? "growth_m" : "protrusion_m"] = json_number<Json>(proofs[i].growth);
            if (proofs[i].cavity) {
                link["cavity"] = true;
            } else {
                link[outer ? "triangle" : "sphere"] = outer ? proofs[i].triangle : proofs[i].sphere;
            }
            const Vec3& p = proofs[i].witness;
            link[outer ? "witness_m" : "center_m"] = {p.x, p.y, p.z};
        }
        links.push_back(std::move(link));
    }
    return links;
}

/// Returns what a model does in poses.
template <class Json> Json json_of_consequences(const Robot& robot, const Consequences& found) {
    Json pairs = Json::array(), elements = Json::array();
    for (const PairConsequence& pair : found.pairs) {
        pairs.push_back({{"link1", robot.links[pair.first].name},
                         {"link2", robot.links[pair.second].name},
                         {"contacts", pair.contacts},
                         {"missed", pair.missed},
                         {"false_contacts", pair.false_contacts}});
    }
    for (const ElementConsequence& element : found.elements) {
        elements.push_back({{"link", robot.links[element.link].name},
                            {"element", element.element},
                            {"false_contacts", element.false_contacts}});
    }
    return {{"poses", found.poses},           {"in_contact", found.in_contact},
            {"refused", found.refused},       {"falsely_refused", found.falsely_refused},
            {"missed", found.missed},         {"pairs", std::move(pairs)},
            {"elements", std::move(elements)}};
}

/// Returns the links with spheres.
template <class Json> Json json_of_links(const CollisionModel& model) {
    Json links = Json::array();
    for (std::size_t i = 0; i < model.elements.size(); ++i) {
        const Elements& elements = model.elements[i];
        if (!elements.empty()) {
            links.push_back({{"link", model.robot->links[i].name},
                             {"spheres", elements.size()},
                             {"certified_cover", model.sources[i] == CollisionModel::Source::cover}});
            if (!elements.are_spheres()) {
                links.back()["kinds"] = json_of_kinds<Json>(kinds_of(elements));
            }
        }
    }
    return links;
}

/// Returns all pairs of links with spheres.
template <class Json> Json json_of_pairs(const CollisionModel& model, const SelfCollisionMatrix& matrix) {
    Json pairs = Json::array();
    for (const LinkPair& pair : matrix.pairs) {
        Json json{{"link1", model.robot->links[pair.first].name},
                  {"link2", model.robot->links[pair.second].name},
                  {"ignored", pair.reason != PairReason::none},
                  {"reason", pair.reason == PairReason::none ? Json() : Json(to_string(pair.reason))},
                  {"proved", pair.proved}};
        if (pair.samples > 0) {
            json["samples"] = pair.samples;
            json["contacts"] = pair.touching;
        }
        if (pair.geometry_samples > 0) {
            json["geometry_samples"] = pair.geometry_samples;
            json["geometry_contacts"] = pair.geometry_touching;
        }
        if (pair.found_touching) {
            json["contact_found"] = true;
        }
        pairs.push_back(std::move(json));
    }
    return pairs;
}

/// Returns the whole matrix. `words`: where the spheres are from.
template <class Json>
Json json_of_matrix(const std::string& robot, const std::string& words, std::uint64_t seed,
                    const Kinematics& kinematics, const CollisionModel& model, const SelfCollisionMatrix& matrix) {
    Json reference = Json::object();
    for (std::size_t i = 0; i < matrix.reference.size(); ++i) {
        reference[kinematics.freedoms()[i].joint] = matrix.reference[i];
    }
    return {{"original", robot},
            {"spheres_from", words},
            {"seed", seed},
            {"samples", matrix.samples},
            {"confidence", matrix.confidence},
            {"rate_bound", matrix.samples > 0 ? Json(matrix.rate_bound()) : Json()},
            {"joint_rate_bound", matrix.samples > 0 ? Json(matrix.joint_rate_bound()) : Json()},
            {"reference_pose", std::move(reference)},
            {"notes", model.notes},
            {"links", json_of_links<Json>(model)},
            {"pairs", json_of_pairs<Json>(model, matrix)}};
}

} // namespace judge
} // namespace foam
