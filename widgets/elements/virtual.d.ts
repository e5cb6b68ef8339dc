declare module 'virtual:fastslam-files' {
  export const example: string
  /** By name, packed as gzip in base64. */
  export const programs: Record<string, string | undefined>
  export const worker: string
  export const words: Record<string, import('./files').Catalogue | undefined>
}
