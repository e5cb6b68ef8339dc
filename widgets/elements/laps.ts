/** The laps behind a cell of the chapter's table, or a point of the chart of universes: whose program runs them, which job, and of which setting. */
export function lapsOf(universes: number | string, proposal: string, matcher: string): { tag: string; job: string; query: string } {
  return { tag: 'fastslam-lap', job: 'laps', query: `course=apartment&odometry=1&range-std=0.02&universes=${universes}&proposal=${proposal}&matcher=${matcher}` }
}
