// A film is a piece thinner than about two steps of the grid, which rounding may even have turned over. Wants FragmentRecord.
float filmVolume(FragmentRecord r, float step_size) { return r.measure.y * step_size + r.measure.w * step_size * step_size; }
