// What a saved notebook weighs: the state of all its widgets, as notebooks and books keep it.
import { execFileSync } from 'node:child_process'
import { expect, test } from '@playwright/test'
import { cache } from '../../scripts/lib.mjs'

test('ten figures share one script in a saved notebook', () => {
  const script = `
import json, ipywidgets, fastslam_widgets as f
figures = [getattr(f, name)() for name in f.__all__[:10]]
state = ipywidgets.Widget.get_manager_state(widgets=None)
print(len(json.dumps(state).encode()), len(figures))
f.FastslamLap().library.close()
assert f.FastslamLap().library.comm is not None
`
  const [bytes, figures] = execFileSync(cache('python', 'clients', 'bin', 'python'), ['-c', script], { encoding: 'utf8' }).split(' ').map(Number)
  expect(figures).toBe(10)
  expect(bytes).toBeLessThan(3_000_000)
})
