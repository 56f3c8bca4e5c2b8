// The contract on every mesh there is: of all models of the shared folder and of libcgal-demo (tools/corpus.sh) that bound a
// solid, 10 and 100 pieces with three seeds each, and 1000. Which do is for the project's own check to say; where somebody
// else has looked at a model, a refusal has to agree with that.
#include "modules/brittle/mesh/check.h"
#include "tests/module/whole_fracture.h"
#include "tests/support/folders.h"
#include "tests/support/shared_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

namespace {

namespace fs = std::filesystem;
using namespace whole;

fs::path corpusFolder() { return support::sourceFolder() / "build" / "corpus" / "libcgal-demo" / "meshes"; }

// What others say of a model: nothing, or that it bounds a solid.
struct Candidate {
    fs::path path;
    bool known_solid = false;
};

std::vector<std::string> csvCells(const std::string& line) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (const char c : line) {
        if (c == '"')
            quoted = !quoted;
        else if (c == ',' && !quoted)
            cells.emplace_back();
        else
            cells.back() += c;
    }
    return cells;
}

// The models that the catalogue of the shared folder, which other programs have filled, finds closed, consistently oriented
// and free of crossings.
std::vector<std::string> solidsOfCatalogue(const fs::path& folder) {
    std::ifstream file(folder / "catalogue.csv");
    std::vector<std::string> solids;
    std::map<std::string, size_t> column;
    for (std::string line; std::getline(file, line);) {
        const std::vector<std::string> cells = csvCells(line);
        if (column.empty()) {
            for (size_t k = 0; k < cells.size(); ++k)
                column[cells[k]] = k;
            continue;
        }
        const auto cell = [&](const char* name) { return cells.at(column.at(name)); };
        if (cell("closed") == "yes" && cell("consistently_oriented") == "yes" && cell("self_intersects") == "no")
            solids.push_back(cell("file"));
    }
    return solids;
}

// Of the broken files, those that the table beside them marks as sound for all that.
std::vector<std::string> validOfBroken(const fs::path& folder) {
    std::ifstream file(folder / "README.md");
    std::vector<std::string> valid;
    for (std::string line; std::getline(file, line);) {
        const size_t first = line.find('`'), second = line.find('`', first + 1);
        if (line.starts_with("| `") && line.find("| VALID") != std::string::npos)
            valid.push_back(line.substr(first + 1, second - first - 1));
    }
    return valid;
}

void addFolder(const fs::path& folder, const std::vector<std::string>& solids, std::vector<Candidate>& candidates) {
    std::error_code none;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
        const std::string ending = entry.path().extension().string();
        if (!entry.is_regular_file() || ending == ".md" || ending == ".csv") continue;
        const bool known = std::find(solids.begin(), solids.end(), entry.path().filename().string()) != solids.end();
        candidates.push_back({entry.path(), known});
    }
}

std::vector<Candidate> allCandidates() {
    std::vector<Candidate> candidates;
    const fs::path meshes = support::sharedFolder() / "meshes";
    addFolder(meshes, solidsOfCatalogue(meshes), candidates);
    addFolder(meshes / "bad", validOfBroken(meshes / "bad"), candidates);
    addFolder(corpusFolder(), {}, candidates);
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) { return a.path < b.path; });
    return candidates;
}

// Why a model cannot be broken, or nothing and the model.
std::optional<std::string> refusal(const fs::path& path, std::optional<Model>& model) {
    const auto imported = brittle::importMesh(path);
    if (!imported) return imported.error().message;
    auto prepared = brittle::prepareMesh(*imported);
    if (!prepared) return prepared.error().message;
    const auto checked = brittle::checkMesh(prepared->mesh, prepared->topology);
    if (!checked) return checked.error().message;
    model = modelFrom(*imported);
    return {};
}

void PrintTo(const Candidate& candidate, std::ostream* out) { *out << candidate.path; }

class EveryMesh : public testing::TestWithParam<Candidate> {};

TEST_P(EveryMesh, KeepsTheContract) {
    std::optional<Model> model;
    const auto refused = refusal(GetParam().path, model);
    if (refused) {
        EXPECT_FALSE(GetParam().known_solid) << "refused, though it bounds a solid: " << *refused;
        GTEST_SKIP() << *refused;
    }
    struct Break {
        uint32_t sites;
        uint64_t seed;
    };
    for (const auto& [sites, seed] :
         {Break{10, 1}, Break{10, 2}, Break{10, 3}, Break{100, 1}, Break{100, 2}, Break{100, 3}, Break{1000, 1}}) {
        SCOPED_TRACE(std::to_string(sites) + " sites, seed " + std::to_string(seed));
        brittle::FractureOptions options;
        options.site_count = sites;
        options.seed = seed;
        expectContract(*model, options);
    }
}

std::string nameOf(const testing::TestParamInfo<Candidate>& info) {
    std::string name = std::to_string(info.index) + "_" + info.param.path.filename().string();
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return name;
}

INSTANTIATE_TEST_SUITE_P(Long, EveryMesh, testing::ValuesIn(allCandidates()), nameOf);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(EveryMesh);

// So that a check that refuses everything, or a list that came out empty, is not taken for success.
TEST(LongEveryMeshList, HoldsWhatWasFound) {
    SKIP_WITHOUT_MESHES();
    const fs::path meshes = support::sharedFolder() / "meshes";
    EXPECT_GE(solidsOfCatalogue(meshes).size(), 25u);
    EXPECT_GE(validOfBroken(meshes / "bad").size(), 7u);
    if (!fs::exists(corpusFolder())) GTEST_SKIP() << "no models in " << corpusFolder() << "; tools/corpus.sh fetches them";
    uint32_t sound = 0;
    std::vector<Candidate> demo;
    addFolder(corpusFolder(), {}, demo);
    for (const Candidate& candidate : demo) {
        std::optional<Model> model;
        sound += refusal(candidate.path, model) ? 0 : 1;
    }
    EXPECT_GE(sound, 75u) << "of " << demo.size();
}

} // namespace
