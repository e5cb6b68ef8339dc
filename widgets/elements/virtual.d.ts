declare module 'virtual:fastslam-files' {
  export const example: string
  export const program: string
  export const worker: string
}
