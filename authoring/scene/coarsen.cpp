// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "authoring/scene/raster.h"

// A coarse map of fine ground, for what has to be worked out over and over again. Asking whether the middle
// of a coarse cell is free would close doors narrower than a cell, and asking whether anything in it is free
// would open walls thinner than one. So a coarse cell stands for its largest connected piece of free ground,
// and one may go from a cell to the next where these pieces touch.
namespace throng::authoring {
namespace {

class Coarsener {
  public:
    Coarsener(const WalkMap& fine, const FieldGrid& coarse)
        : fine_(fine), coarse_(coarse), owner_(fine.cost.size()), piece_(fine.cost.size(), kNoPiece) {
        result_.grid = coarse;
        result_.cost.assign(cellCount(coarse), kUnreachable);
        result_.open_sides.assign(cellCount(coarse), 0);
        if (!fine.one_way.empty()) result_.one_way.assign(cellCount(coarse), glm::vec2(0.0f));
        for (std::uint32_t cell = 0; cell < owner_.size(); ++cell)
            owner_[cell] =
                cellAt(coarse, cellCentre(fine.grid, cell % fine.grid.width, cell / fine.grid.width));
    }

    CoarseMap run() {
        findPieces();
        describePieces();
        openSides();
        for (std::uint32_t cell = 0; cell < owner_.size(); ++cell)
            if (!isChosen(cell)) owner_[cell] = gpu::NO_INDEX;
        return {std::move(result_), std::move(owner_), std::move(share_)};
    }

  private:
    static constexpr std::uint32_t kNoPiece = ~0u;
    struct Piece {
        std::uint32_t first = 0;  // a fine cell of it
        std::uint32_t cells = 0;
    };

    /// Floods each piece of free ground within one coarse cell.
    void findPieces() {
        std::vector<std::uint32_t> open;
        for (std::uint32_t start = 0; start < owner_.size(); ++start) {
            if (piece_[start] != kNoPiece || fine_.cost[start] >= kUnreachable) continue;
            const auto piece = static_cast<std::uint32_t>(pieces_.size());
            pieces_.push_back({start, 0});
            piece_[start] = piece;
            open.push_back(start);
            while (!open.empty()) {
                const std::uint32_t cell = open.back();
                open.pop_back();
                ++pieces_[piece].cells;
                visitNeighbours(fine_.grid, cell, [&](std::uint32_t next) {
                    if (piece_[next] != kNoPiece || owner_[next] != owner_[start] ||
                        fine_.cost[next] >= kUnreachable)
                        return;
                    piece_[next] = piece;
                    open.push_back(next);
                });
            }
        }
    }

    void describePieces() {
        chosen_.assign(cellCount(coarse_), kNoPiece);
        for (std::uint32_t piece = 0; piece < pieces_.size(); ++piece) {
            std::uint32_t& chosen = chosen_[owner_[pieces_[piece].first]];
            if (chosen == kNoPiece || pieces_[piece].cells > pieces_[chosen].cells) chosen = piece;
        }
        std::vector<double> cost(cellCount(coarse_));
        share_.assign(cellCount(coarse_), 0.0f);
        for (std::uint32_t cell = 0; cell < owner_.size(); ++cell) {
            if (!isChosen(cell)) continue;
            cost[owner_[cell]] += fine_.cost[cell];
            if (!fine_.one_way.empty()) result_.one_way[owner_[cell]] += fine_.one_way[cell];
        }
        for (std::size_t cell = 0; cell < cost.size(); ++cell) {
            if (chosen_[cell] == kNoPiece) continue;
            const auto count = static_cast<float>(pieces_[chosen_[cell]].cells);
            const float ratio = fine_.grid.cell_size / coarse_.cell_size;
            share_[cell] = std::min(1.0f, count * ratio * ratio);
            result_.cost[cell] = static_cast<float>(cost[cell]) / count;
            if (result_.one_way.empty()) continue;
            // One-way only where most of it is.
            const float share = glm::length(result_.one_way[cell]) / count;
            result_.one_way[cell] = share > 0.5f ? glm::normalize(result_.one_way[cell]) : glm::vec2(0.0f);
        }
    }

    bool isChosen(std::uint32_t cell) const {
        return piece_[cell] != kNoPiece && chosen_[owner_[cell]] == piece_[cell];
    }

    void openSides() {
        const std::uint32_t width = fine_.grid.width;
        for (std::uint32_t cell = 0; cell < owner_.size(); ++cell) {
            if (!isChosen(cell)) continue;
            if (cell % width + 1 < width && isChosen(cell + 1) && owner_[cell + 1] != owner_[cell])
                result_.open_sides[owner_[cell]] |= gpu::OPEN_TO_X;
            if (cell + width < owner_.size() && isChosen(cell + width) &&
                owner_[cell + width] != owner_[cell])
                result_.open_sides[owner_[cell]] |= gpu::OPEN_TO_Y;
        }
    }

    const WalkMap& fine_;
    const FieldGrid& coarse_;
    WalkMap result_;
    std::vector<float> share_;
    std::vector<std::uint32_t> owner_;  // coarse cell of each fine one
    std::vector<std::uint32_t> piece_;  // of each fine cell
    std::vector<Piece> pieces_;
    std::vector<std::uint32_t> chosen_;  // piece of each coarse cell
};

}  // namespace

CoarseMap coarsen(const WalkMap& fine, const FieldGrid& coarse) {
    return Coarsener(fine, coarse).run();
}

}  // namespace throng::authoring
