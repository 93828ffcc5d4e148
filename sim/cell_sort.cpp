// SPDX-License-Identifier: Apache-2.0
#include "sim/cell_sort.h"

namespace throng::sim {
namespace {

const gl::Declaration kCount = {
    "cells",
    {"shaders/cells/cells_count.comp"},
    {"ParametersBlock", "States", "ChartCells", "ChartShifts", "CellCounts", "StripCounts", "StripMarks",
     "StripListEnd", "RowCells"},
    {"CellCounts", "StripCounts", "StripMarks", "StripListEnd", "StripList", "RowCells"}};
const gl::Declaration kSum = {"cells", {"shaders/cells/counts_sum.comp"}, {"Counts"}, {"GroupSums"}};
const gl::Declaration kScan = {
    "cells",
    {"shaders/cells/strips_scan.comp"},
    {"Counts", "GroupSums", "StripListEnd"},
    {"StripStarts", "StripListEnd", "FillDispatch", "LiveDispatch", "TouchDispatch"}};
const gl::Declaration kFill = {"cells",
                               {"shaders/cells/strips_fill.comp"},
                               {"FillDispatch", "StripList", "CellCounts"},
                               {"StripCounts", "StripMarks", "CellOffsets"}};
const gl::Declaration kScatter = {
    "cells",
    {"shaders/cells/cells_scatter.comp"},
    {"ParametersBlock", "RowCells", "LiveDispatch", "CellCounts", "CellOffsets", "StripStarts"},
    {"CellCounts", "LooseRows", "SiteSlots"}};
const gl::Declaration kGather = {
    "cells",
    {"shaders/cells/bodies_gather.comp"},
    {"ParametersBlock", "LiveDispatch", "People", "States", "RowCells", "LooseRows", "StripStarts",
     "CellOffsets", "Chests", "ChartCells", "ChartShifts", "Belts"},
    {"SiteSlots", "Bodies", "Walkers", "Sites", "SlotImages", "RowSlots"}};

}  // namespace

CellSort::CellSort(const gl::ShaderLibrary& library, Buffers& buffers, const gpu::Parameters& parameters)
    : buffers_(buffers),
      rows_(parameters.site_rows),
      count_(buffers.connect(library, kCount, buffers.definitions())),
      sum_(buffers.connect(library, kSum)),
      scan_(buffers.connect(library, kScan)),
      fill_(buffers.connect(library, kFill)),
      scatter_(buffers.connect(library, kScatter)),
      gather_(buffers.connect(library, kGather, buffers.definitions())) {
    const auto strips = static_cast<std::uint32_t>(buffers.strip_counts.bytes() / sizeof(std::uint32_t));
    sum_.set("count_total", strips);
    scan_.set("count_total", strips);
    scan_threads_ = (strips + gpu::COUNTS_PER_THREAD - 1) / gpu::COUNTS_PER_THREAD;
}

void CellSort::run(SiteIds ids) {
    for (gl::ComputeProgram* program : {&scatter_, &gather_})
        program->set("ids_are_rows", ids == SiteIds::rows ? 1u : 0u);
    count_.dispatch(rows_);
    sum_.dispatch(scan_threads_);
    scan_.dispatch(scan_threads_);
    fill_.dispatchIndirect(buffers_.fill_dispatch);
    scatter_.dispatch(rows_);
    gather_.dispatchUpTo(buffers_.slotCapacity(), buffers_.live_dispatch);
}

}  // namespace throng::sim
