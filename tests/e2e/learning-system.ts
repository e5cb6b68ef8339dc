// A learning system that speaks SCORM 1.2: the run-time that many of them are built on, around a frame with a package in it.
import { readFileSync } from 'node:fs'
import { createServer, type IncomingMessage, type ServerResponse } from 'node:http'
import { createRequire } from 'node:module'
import type { AddressInfo } from 'node:net'
import type { Frame, Page } from '@playwright/test'
import { strFromU8 } from 'fflate'
import { Figure, openLab } from './figure'
import { expect } from './fixtures'

/** A learning system: a page with scorm-again around a frame with the package in it, which keeps what the run-time commits. */
export class LearningSystem {
  address = ''
  private readonly server = createServer()

  constructor(
    readonly page: Page,
    private readonly tag: string,
    private readonly files: Record<string, Uint8Array>,
  ) {}

  /** The learner opens the package, for the first time or again. */
  async visit(): Promise<Figure> {
    if (!this.address) await this.listen()
    await this.page.goto(this.address)
    const figure = new Figure(this.frame, this.tag)
    await expect(figure.element.locator('.stage.live')).toBeVisible()
    await openLab(figure.element)
    return figure
  }

  /** The frame with the package. */
  get frame(): Frame {
    return this.page.frames()[1]!
  }

  /** What a window that is closed does, until the run-time has been told that it is over. */
  async leave(): Promise<void> {
    await this.page.evaluate(() => {
      delete sessionStorage['finished']
      document.querySelector('iframe')!.remove()
    })
    await expect.poll(() => this.page.evaluate(() => sessionStorage['finished'] ?? '')).toBe('yes')
  }

  /** What the package set last. */
  told(element: string): Promise<string | undefined> {
    return this.page.evaluate(name => JSON.parse(sessionStorage['told'] ?? '{}')[name] as string | undefined, element)
  }

  close(): void {
    this.server.close()
  }

  private async listen(): Promise<void> {
    const { files } = this
    const manifest = strFromU8(files['imsmanifest.xml']!)
    expect(manifest).toMatch(/<schemaversion>1\.2<\/schemaversion>/)
    const start = /adlcp:scormtype="sco" href="([^"]+)"/.exec(manifest)![1]!
    for (const [, file] of manifest.matchAll(/<file href="([^"]+)"/g)) expect(files[file!]).toBeDefined()
    const mastery = /<adlcp:masteryscore>(\d+)</.exec(manifest)?.[1] ?? ''
    const runtime = readFileSync(createRequire(import.meta.url).resolve('scorm-again/scorm12'), 'utf8')
    const system = `<!doctype html><html lang="en"><head><title>LMS</title><link rel="icon" href="data:," /><script src="runtime.js"></script></head><body><script>
      const kept = JSON.parse(sessionStorage.kept ?? '{}')
      const mastery = ${JSON.stringify(mastery)}
      window.API = new Scorm12API({ logLevel: 5 })
      if (mastery) API.cmi.student_data.mastery_score = mastery
      if (kept.cmi) API.loadFromJSON(kept.cmi, 'cmi')
      const set = API.LMSSetValue.bind(API)
      API.LMSSetValue = (name, value) => {
        sessionStorage.told = JSON.stringify({ ...JSON.parse(sessionStorage.told ?? '{}'), [name]: value })
        return set(name, value)
      }
      API.on('LMSCommit', () => (sessionStorage.kept = JSON.stringify({ cmi: API.renderCMIToJSONObject().cmi })))
      API.on('LMSFinish', () => (sessionStorage.finished = 'yes'))
    </script><iframe src="${start}" width="800" height="780"></iframe></body></html>`
    const types: Record<string, string> = { html: 'text/html', js: 'text/javascript', css: 'text/css', svg: 'image/svg+xml' }
    this.server.on('request', ({ url }: IncomingMessage, response: ServerResponse) => {
      const name = url!.slice(1).split('?')[0]!
      const body = name === 'lms' ? system : name === 'runtime.js' ? runtime : files[name]
      response.writeHead(body ? 200 : 404, { 'Content-Type': types[name.split('.').at(-1)!] ?? (name === 'lms' ? 'text/html' : 'application/octet-stream') }).end(body)
    })
    await new Promise<void>(done => this.server.listen(0, '127.0.0.1', done))
    this.address = `http://127.0.0.1:${(this.server.address() as AddressInfo).port}/lms`
  }
}

export const forgiveSystem = (complaints: string[]) => complaints.splice(0, Infinity, ...complaints.filter(line => !/^left the site: http:\/\/127\.0\.0\.1/.test(line)))
