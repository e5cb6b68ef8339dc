// npm run threads [-- LOG [PARTICLES]]: how long a log takes on 1, 2, 4 … threads, as a table; the fingerprint must be the same on all. Of any use on an idle machine only, and it says
// where the machine is not. Without a log, the example is mapped.
import { availableParallelism, loadavg } from 'node:os'
import { join } from 'node:path'
import { bold, isMain, main, root, run, say, StepError } from './lib.mjs'

/** Numbers of threads that are tried: powers of two, and all there are. @param {number} all */
export const threadCounts = all => [...new Set([...Array(Math.floor(Math.log2(all)) + 1).keys()].map(k => 2 ** k).concat(all))]

if (isMain(import.meta)) {
  await main(async () => {
    const [log = join(root, 'www', 'public', 'example.clf.gz'), particles = '16'] = process.argv.slice(2)
    await run('cargo', ['build', '--release', '--bin', 'fastslam'])
    const [load = 0] = loadavg()
    say(bold(`\n  ${log}, ${particles} particles, the best of three runs`))
    if (load > 0.5) say(`  (other programs are running, load ${load.toFixed(1)}: these numbers say little)`)
    let [first, fingerprint] = [0, '']
    for (const threads of threadCounts(availableParallelism())) {
      const seconds = []
      for (let time = 0; time < 3; time++) {
        const { answer } = await run('cargo', ['run', '--quiet', '--release', '--bin', 'fastslam', '--', 'log', log, '--particles', particles, '--threads', `${threads}`, '--json'])
        const { elapsed_s, digest } = JSON.parse(answer)
        if (fingerprint && digest !== fingerprint) throw new StepError(`The fingerprint on ${threads} threads is ${digest}, and not ${fingerprint}.`)
        fingerprint = digest
        seconds.push(elapsed_s)
      }
      const best = Math.min(...seconds)
      first ||= best
      say(`  ${`${threads}`.padStart(3)} threads ${best.toFixed(2).padStart(8)} s, ${(first / best).toFixed(2)} × as fast`)
    }
  })
}
